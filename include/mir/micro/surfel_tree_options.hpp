// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cstdint>

namespace mir {

/// Which sphere is put around the discs of a node. All of them contain every disc.
enum class SphereFit {
    mean,     ///< around the mean of the centres
    ritter,   ///< two passes of Ritter's; some percent larger than the smallest
    smallest  ///< at most 0.1 % larger than the smallest
};

/// How the discs of a node are dealt to its children.
enum class SurfelSplit {
    median,  ///< halves of equal number, along the longest axis of the centres' box
    /// By the surface area orientation heuristic; halves where nodes are small. Cuts part walls
    /// that meet: of a Cornell box's million inner nodes 139 have mixed normals, not 68 786.
    orientation
};

/// How a hierarchy of discs is built. Choices change speed and where approximate rays stop, never
/// what exact rays meet.
struct SurfelTreeOptions {
    /// Most nodes on the way from the root to a disc. Traversal has a stack of that size.
    static constexpr std::uint32_t depth_limit = 48;

    SphereFit sphere = SphereFit::ritter;          ///< what bounds the discs of a node
    SurfelSplit split = SurfelSplit::orientation;  ///< how discs are dealt to children
    std::uint32_t median_below = 16;  ///< discs of nodes that are always halved by number
    std::uint32_t bins = 16;  ///< in which `orientation` looks for planes, per axis; 2 to 64

    /// Most nodes on the way to a disc, at least those of a balanced tree. 1 to depth_limit: nodes
    /// are halved by number where their children could not keep it else.
    std::uint32_t max_depth = depth_limit;
};

/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const SurfelTreeOptions& options) {
    expects(options.bins >= 2 && options.bins <= 64,
            "the surfel tree's bins must lie between 2 and 64 (fewer find no plane, more have no "
            "room); choose a number there");
    expects(options.max_depth >= 1 && options.max_depth <= SurfelTreeOptions::depth_limit,
            "the surfel tree's max_depth must lie between 1 and 48, the stack of its traversal; "
            "choose one there");
}

}  // namespace mir
