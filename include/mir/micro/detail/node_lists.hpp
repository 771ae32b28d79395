// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"

namespace mir::detail {

/// Calls write(place, lane) for lanes with any `pictures`. Places count from `length` on. Returns
/// how many lanes that are.
template <class Write>
MIR_HD std::uint32_t put_where_any(const LaneGroup& group, std::uint32_t length,
                                   const LaneGroup::PerLane<std::uint32_t>& pictures,
                                   const Write& write) {
    const std::uint32_t these =
        group.ballot([&](std::uint32_t lane) { return pictures[lane] != 0; });
    group.each([&](std::uint32_t lane) {
        if (pictures[lane] != 0) write(length + LaneGroup::count_before(these, lane), lane);
    });
    return LaneGroup::count(these);
}

/// Puts the nodes of lanes with any `pictures` behind a list of nodes. The list has `length` nodes
/// (MicroBufferSpace::Shares). Returns how many were put.
template <class List>
MIR_HD std::uint32_t put_nodes(const LaneGroup& group, List& list, std::uint32_t length,
                               const LaneGroup::PerLane<std::uint32_t>& nodes,
                               const LaneGroup::PerLane<std::uint32_t>& pictures) {
    return put_where_any(group, length, pictures, [&](std::uint32_t i, std::uint32_t lane) {
        list.node[i] = nodes[lane];
        list.pictures[i] = static_cast<std::uint8_t>(pictures[lane]);
    });
}

/// The same of nodes whose children are to be taken (MicroBufferSpace::Parents).
template <class List>
MIR_HD std::uint32_t put_parents(const LaneGroup& group, List& list, std::uint32_t length,
                                 const LaneGroup::PerLane<std::uint32_t>& nodes,
                                 const LaneGroup::PerLane<std::uint32_t>& right,
                                 const LaneGroup::PerLane<std::uint32_t>& pictures) {
    return put_where_any(group, length, pictures, [&](std::uint32_t i, std::uint32_t lane) {
        list.node[i] = nodes[lane];
        list.right[i] = right[lane];
        list.pictures[i] = static_cast<std::uint8_t>(pictures[lane]);
    });
}

}  // namespace mir::detail
