// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cstdint>

namespace mir {

/// How a wide bounding volume hierarchy is built. Choices change speed and memory, never what is
/// visible.
struct WideBvhOptions {
    /// Most nodes on the way from the root to a triangle; traversal has a stack of that size.
    static constexpr std::uint32_t depth_limit = 32;

    /// Most triangles that a leaf may hold, whatever the options say.
    static constexpr std::uint32_t largest_leaf = 8;

    std::uint32_t leaf_size = 4;  ///< most triangles of a leaf; 1 to largest_leaf
    std::uint32_t bins = 32;      ///< in which large nodes look for a plane, per axis; 4 to 32

    /// Most nodes on the way from the root to a triangle, raised to what a balanced tree needs.
    /// 1 to depth_limit: nodes are halved by number where their children could not keep it else.
    std::uint32_t max_depth = depth_limit;
};

/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const WideBvhOptions& options) {
    expects(options.leaf_size >= 1 && options.leaf_size <= WideBvhOptions::largest_leaf,
            "the wide tree's leaf_size must lie between 1 and 8 (a leaf is one slot of a node); "
            "choose one there");
    expects(options.bins >= 4 && options.bins <= 32,
            "the wide tree's bins must lie between 4 and 32 (fewer find no plane, more have no "
            "room); choose a number there");
    expects(options.max_depth >= 1 && options.max_depth <= WideBvhOptions::depth_limit,
            "the wide tree's max_depth must lie between 1 and 32, the stack of its traversal; "
            "choose one there");
}

}  // namespace mir
