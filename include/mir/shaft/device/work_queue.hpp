// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"

namespace mir {

/// Work that one kernel leaves for the next, in memory with room for `capacity` items. The order
/// changes from run to run, so nothing may depend on it.
template <class T>
struct WorkQueue {
    T* items = nullptr;              ///< the first size() are there
    std::uint32_t capacity = 0;      ///< items that there is room for
    std::uint32_t* count = nullptr;  ///< that were to be added; starts at 0
    std::uint32_t* taken = nullptr;  ///< by the kernel that empties it; starts at 0

    /// Items in the queue, once the kernel that adds to it has ended.
    [[nodiscard]] MIR_HD std::uint32_t size() const {
        return *count < capacity ? *count : capacity;
    }

    /// Adds item_of(lane) for the lanes whose bit is set. Returns those for which there was no
    /// room.
    template <class ItemOf>
    [[nodiscard]] MIR_HD std::uint32_t append(const LaneGroup& group, std::uint32_t lanes,
                                              const ItemOf& item_of) const {
        if (lanes == 0) return 0;
        const std::uint32_t first = group.add(*count, LaneGroup::count(lanes));
        return lanes & group.ballot([&](std::uint32_t lane) {
            const std::uint32_t at = first + LaneGroup::count_before(lanes, lane);
            if ((lanes >> lane & 1u) != 0 && at < capacity) items[at] = item_of(lane);
            return at >= capacity;
        });
    }

    /// Numbers of items to work on, each once; from size() on there are none.
    [[nodiscard]] MIR_HD std::uint32_t take(const LaneGroup& group,
                                            std::uint32_t items_at_once) const {
        return group.add(*taken, items_at_once);
    }
};

/// A run of luxels and a VPL whose visibility is still to be decided.
struct alignas(8) OpenPair {
    std::uint32_t cluster = 0;  ///< number of the run, of 32 or of 256 luxels as the kernel says
    std::uint32_t vpl = 0;      ///< its place in the set
};

/// A run of luxels and a VPL with all that may hide one. It lies in a pool (LeafPool): the leaves
/// of nodes for 32 luxels, single triangles for 256.
struct alignas(16) ListedPair {
    OpenPair pair;            ///< of the run
    std::uint32_t first = 0;  ///< place in the pool
    std::uint32_t count = 0;  ///< words there
};

}  // namespace mir
