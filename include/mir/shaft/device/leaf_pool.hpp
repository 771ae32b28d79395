// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"

namespace mir {

/// Memory for what shafts meet, filled by kernels and read by the next. A word is for the leaves of
/// a node (MetLeaves::bits) or for the place of a triangle, as the queue says that refers to it.
struct LeafPool {
    std::uint32_t* words = nullptr;  ///< `capacity` of them
    std::uint32_t capacity = 0;      ///< words that there is room for
    std::uint32_t* used = nullptr;   ///< starts at 0

    /// Takes counts[lane] places for each lane, from places[lane] on. Returns the lanes that asked
    /// for some and got them.
    [[nodiscard]] MIR_HD std::uint32_t reserve(const LaneGroup& group,
                                               const LaneGroup::PerLane<std::uint32_t>& counts,
                                               LaneGroup::PerLane<std::uint32_t>& places) const {
        const std::uint32_t some =
            group.ballot([&](std::uint32_t lane) { return counts[lane] > 0; });
        // Asked before more is added: so the count cannot wrap around.
        if (some == 0 || group.add(*used, 0) > capacity) return 0;
        places = counts;
        const std::uint32_t total = group.sums_before(places);
        const std::uint32_t first = group.add(*used, total);
        return some & group.ballot([&](std::uint32_t lane) {
            places[lane] += first;
            return places[lane] + counts[lane] <= capacity;
        });
    }
};

}  // namespace mir
