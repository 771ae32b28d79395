// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"

namespace mir {

/// A run of luxels and a VPL whose visibility is still to be decided.
struct OpenPair {
    std::uint32_t cluster =
        0;  ///< number of the run, of 32 or of 256 luxels as the queue's user says
    std::uint32_t vpl = 0;
};

/// Pairs that one kernel leaves for the next. Their order changes from run to run, so nothing may
/// depend on it. A view of memory with room for all pairs that there can be; `count` starts at 0.
struct PairQueue {
    OpenPair* pairs = nullptr;
    std::uint32_t* count = nullptr;
    std::uint32_t* taken = nullptr;  ///< by the kernel that empties it; starts at 0

    [[nodiscard]] MIR_HD std::uint32_t size() const { return *count; }

    /// Adds pair_of(lane) for the lanes whose bit is set.
    template <class PairOf>
    MIR_HD void append(const LaneGroup& group, std::uint32_t lanes, const PairOf& pair_of) const {
        if (lanes == 0) return;
        const std::uint32_t first = group.add(*count, LaneGroup::count(lanes));
        group.each([&](std::uint32_t lane) {
            if ((lanes >> lane & 1u) == 0) return;
            pairs[first + LaneGroup::count(lanes & ((1u << lane) - 1u))] = pair_of(lane);
        });
    }
};

}  // namespace mir
