// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_clip.hpp"
#include "mir/accel/kd/detail/kd_split.hpp"

#include <span>

namespace mir::detail {

/// How many fragments lie on either side of a plane, and on both.
struct KdSides {
    std::size_t below = 0;
    std::size_t above = 0;
    std::size_t both = 0;
};

/// Sorts fragments by side. Every list is written at each step and grows only where it should, so
/// nothing depends on a branch; each needs room for all. `above` may be where `from` is.
inline KdSides deal_fragments(std::span<const KdFragment> from, int axis, float at,
                              KdFragment* below, KdFragment* above, KdFragment* both) {
    std::size_t to_below = 0;
    std::size_t to_above = 0;
    std::size_t to_both = 0;
    for (const KdFragment& f : from) {
        const bool reaches_above = f.high[axis] > at;
        const bool reaches_below = (f.low[axis] < at) | !reaches_above;
        const Float4 low = f.low_lanes();
        const Float4 high = f.high_lanes();
        below[to_below].set_lanes(low, high);
        above[to_above].set_lanes(low, high);
        both[to_both].set_lanes(low, high);
        to_below += reaches_above ? 0 : 1;
        to_above += reaches_below ? 0 : 1;
        to_both += (reaches_above & reaches_below) ? 1 : 0;
    }
    return {to_below, to_above, to_both};
}

/// Clips the fragments that lie on both sides and appends what is left of them.
inline void clip_straddlers(std::span<const KdFragment> both, const ClipTriangle* triangles,
                            const KdCell& cell, const KdSplit& split, KdSides& sides,
                            KdFragment* below, KdFragment* above) {
    for (const KdFragment& f : both) {
        const KdParts parts = split_fragment(f, triangles[f.triangle], cell, split.axis, split.at);
        below[sides.below] = parts.below;
        above[sides.above] = parts.above;
        sides.below += parts.has_below ? 1 : 0;
        sides.above += parts.has_above ? 1 : 0;
    }
}

/// The two halves of a cell.
inline KdCell cell_below(KdCell cell, const KdSplit& split) {
    cell.high[split.axis] = split.at;
    return cell;
}
inline KdCell cell_above(KdCell cell, const KdSplit& split) {
    cell.low[split.axis] = split.at;
    return cell;
}

}  // namespace mir::detail
