// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide_bvh_view.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/shaft/pair_search.hpp"
#include "mir/shaft/shaft_slabs.hpp"

namespace mir {

/// A leaf of a wide hierarchy in one word: its first triangle and their number, which a hierarchy
/// keeps to eight or fewer.
struct PackedLeaf {
    static constexpr std::uint32_t most_triangles = 1u << 29;

    std::uint32_t bits = 0;

    [[nodiscard]] MIR_HD static bool fits(std::uint32_t first) { return first < most_triangles; }
    [[nodiscard]] MIR_HD static PackedLeaf of(std::uint32_t first, std::uint32_t count) {
        return {first << 3 | (count - 1)};
    }
    [[nodiscard]] MIR_HD std::uint32_t first() const { return bits >> 3; }
    [[nodiscard]] MIR_HD std::uint32_t count() const { return (bits & 7u) + 1; }
};
static_assert(WideNode::width == 8);

/// Leaves that the shafts of a group's lanes meet, a column per lane.
template <std::uint32_t Capacity>
struct LeafColumns {
    static constexpr std::uint32_t capacity = Capacity;

    PackedLeaf leaf[Capacity][LaneGroup::width];
};

/// How far the search of one lane has come.
enum class LeafSearchState : std::uint8_t {
    off,       ///< there was nothing to look for
    running,   ///< nodes are left
    complete,  ///< every leaf that the shaft meets is listed
    given_up   ///< there were too many nodes, leaves or triangles
};

/// A lane's walk of its shaft through a wide hierarchy, a node per step. Leaves are listed without
/// a look at their triangles: lanes that test triangles in between lose step.
struct LeafSearch {
    LeafSearchState state;
    std::uint32_t leaves;     ///< listed
    std::uint32_t triangles;  ///< in them
    std::uint32_t visited;    ///< nodes
    std::uint32_t node;
    std::uint32_t waiting;
    detail::WaitingSlots stack[WideBvhOptions::depth_limit];

    MIR_HD void begin(bool on) {
        state = on ? LeafSearchState::running : LeafSearchState::off;
        leaves = triangles = visited = waiting = node = 0;
    }
    [[nodiscard]] MIR_HD bool is_running() const { return state == LeafSearchState::running; }
};

namespace detail {

/// Slots of a node by what is in them.
struct SlotKinds {
    std::uint32_t inner = 0;
    std::uint32_t leaf = 0;
};

MIR_HD inline SlotKinds slot_kinds(const WideNode& node) {
    SlotKinds kinds;
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        kinds.inner |= node.is_inner(k) ? 1u << k : 0u;
        kinds.leaf |= node.is_leaf(k) ? 1u << k : 0u;
    }
    return kinds;
}

/// Lists the leaves in `slots`; false when there is no room for one of them.
template <std::uint32_t Capacity>
MIR_HD bool list_leaves(const WideNode& node, std::uint32_t slots, std::uint32_t most_triangles,
                        std::uint32_t lane, LeafSearch& search, LeafColumns<Capacity>& columns) {
    for (; slots != 0; slots &= slots - 1) {
        const std::uint32_t k = LaneGroup::lowest(slots);
        const auto count = static_cast<std::uint32_t>(node.count[k]);
        if (search.leaves == Capacity || search.triangles + count > most_triangles ||
            !PackedLeaf::fits(node.ref[k]))
            return false;
        columns.leaf[search.leaves++][lane] = PackedLeaf::of(node.ref[k], count);
        search.triangles += count;
    }
    return true;
}

/// One node.
template <Space S, std::uint32_t Capacity>
MIR_HD void step(const WideBvhView<S>& bvh, const ShaftSlabs& slabs, SearchLimits limits,
                 std::uint32_t lane, LeafSearch& search, LeafColumns<Capacity>& columns) {
    const WideNode& node = bvh.nodes[search.node];
    const std::uint32_t met = met_slots(node, slabs);
    const SlotKinds kinds = slot_kinds(node);
    const std::uint32_t inner = met & kinds.inner;
    bool over = !list_leaves(node, met & kinds.leaf, limits.triangles, lane, search, columns);
    if (inner != 0) search.stack[search.waiting++] = {search.node, inner};
    const bool ended = search.waiting == 0;
    over = over || (!ended && ++search.visited >= limits.nodes);
    if (!ended) {
        WaitingSlots& top = search.stack[search.waiting - 1];
        const std::uint32_t k = LaneGroup::lowest(top.slots);
        top.slots &= top.slots - 1;
        search.node = bvh.nodes[top.node].ref[k];
        if (top.slots == 0) --search.waiting;
    }
    if (ended) search.state = LeafSearchState::complete;
    if (over) search.state = LeafSearchState::given_up;
}

}  // namespace detail

/// Runs the searches of all lanes to their ends, each within `limits`. Where one is complete, and
/// cluster and VPL lie within reach, the lane's column holds every triangle that hits_segment()
/// accepts for some segment of its shaft. A node per turn for all lanes that have one left: lanes
/// that met a leaf or went up come together again before the next.
template <Space S, std::uint32_t Capacity>
MIR_HD void search_leaves(const LaneGroup& group, const WideBvhView<S>& bvh,
                          const LaneGroup::PerLane<ShaftSlabs>& slabs, SearchLimits limits,
                          LaneGroup::PerLane<LeafSearch>& searches,
                          LeafColumns<Capacity>& columns) {
    while (group.ballot([&](std::uint32_t lane) { return searches[lane].is_running(); }) != 0)
        group.each([&](std::uint32_t lane) {
            if (searches[lane].is_running())
                detail::step(bvh, slabs[lane], limits, lane, searches[lane], columns);
        });
}

}  // namespace mir
