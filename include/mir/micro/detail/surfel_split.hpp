// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/detail/orientation_bins.hpp"
#include "mir/micro/surfel_tree_options.hpp"

#include <algorithm>
#include <bit>

namespace mir::detail {

/// Nodes on a way through a balanced tree over n discs, the leaf included.
inline std::uint32_t balanced_depth_of(std::size_t n) {
    return n == 0 ? 0 : 1 + static_cast<std::uint32_t>(std::bit_width(n - 1));
}

inline Bounds box_of_centres(std::span<const Surfel> surfels) {
    Bounds box;
    for (const Surfel& s : surfels) box.add(s.position);
    return box;
}

/// Puts the lower half along the longest axis of the centres' box first. Returns its size.
inline std::size_t halve(std::span<Surfel> surfels, const Bounds& box) {
    const Vec3 extent = box.high - box.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::size_t middle = surfels.size() / 2;
    std::nth_element(
        surfels.begin(), surfels.begin() + static_cast<std::ptrdiff_t>(middle), surfels.end(),
        [axis](const Surfel& a, const Surfel& b) { return a.position[axis] < b.position[axis]; });
    return middle;
}

/// Puts the discs of the left child first. Returns their number, at least one and not all. `room`
/// is the number of nodes that may lie on a way below this one. No tree is deeper than its options
/// say: a node with n discs has room for balanced_depth_of(n) - 1 at least, since halves keep that,
/// and other cuts are made only where it stays true of both sides.
inline std::size_t split(std::span<Surfel> surfels, const SurfelTreeOptions& options,
                         std::uint32_t room) {
    if (options.split == SurfelSplit::median) return halve(surfels, box_of_centres(surfels));
    const OrientationGrid grid(surfels, options.bins);
    const Bounds& box = grid.centres;
    if (surfels.size() < options.median_below) return halve(surfels, box);
    OrientationCut best;
    for (int axis = 0; axis < OrientationGrid::axes; ++axis) {
        if (grid.is_flat(axis)) continue;
        const OrientationCut cut = best_cut(surfels, grid, axis);
        if (cut.border != 0 && cut.cost < best.cost) best = cut;
    }
    if (best.border == 0) return halve(surfels, box);
    const auto middle = std::partition(surfels.begin(), surfels.end(), [&](const Surfel& s) {
        return grid.bin(s, best.axis) < best.border;
    });
    const auto left = static_cast<std::size_t>(middle - surfels.begin());
    const std::size_t more = std::max(left, surfels.size() - left);
    return balanced_depth_of(more) <= room ? left : halve(surfels, box);
}

}  // namespace mir::detail
