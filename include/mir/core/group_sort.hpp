// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"

namespace mir {

/// Sorts every aligned run of `run` items by a group, the smallest first. It takes the first
/// `count` items. Both are powers of two, `count` is at least 64, `run` at least 2 and at most
/// `count`. The items are in memory that all lanes reach; count log2(run)^2 / 4 comparisons.
/// Source: Batcher, "Sorting networks and their applications", AFIPS 1968 (bitonic sort).
template <class T>
MIR_HD void sort_runs(const LaneGroup& group, T* items, std::uint32_t count, std::uint32_t run) {
    for (std::uint32_t size = 2; size <= run; size *= 2)
        for (std::uint32_t stride = size / 2; stride > 0; stride /= 2)
            group.each([&](std::uint32_t lane) {
                for (std::uint32_t pair = lane; pair < count / 2; pair += LaneGroup::width) {
                    const std::uint32_t i = 2 * pair - (pair & (stride - 1));
                    // Halves of a run that is not yet whole are sorted in turns, up and down.
                    const bool is_upwards = size == run || (i & size) == 0;
                    const T a = items[i];
                    const T b = items[i + stride];
                    if ((a > b) == is_upwards) {
                        items[i] = b;
                        items[i + stride] = a;
                    }
                }
            });
}

}  // namespace mir
