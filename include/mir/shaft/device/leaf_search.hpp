// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/quantised_bvh.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/shaft/exact/pair_search.hpp"
#include "mir/shaft/exact/shaft_slabs.hpp"

namespace mir {

/// Leaves of one node of a wide hierarchy, in one word. The node and a bit for each slot. Empty
/// slots may be among them.
struct MetLeaves {
    static constexpr std::uint32_t most_nodes = 1u << 24;  ///< larger numbers of nodes do not fit

    std::uint32_t bits = 0;  ///< number of the node, then a bit for each of eight slots

    /// Leaves of node `node` < most_nodes in the slots whose bits are set.
    [[nodiscard]] MIR_HD static MetLeaves of(std::uint32_t node, std::uint32_t slots) {
        return {node << WideNode::width | slots};
    }
    /// Number of the node.
    [[nodiscard]] MIR_HD std::uint32_t node() const { return bits >> WideNode::width; }
    /// Bit k: slot k is among them.
    [[nodiscard]] MIR_HD std::uint32_t slots() const {
        return bits & ((1u << WideNode::width) - 1u);
    }
};
static_assert(WideNode::width == 8);

/// Leaves that the shafts of a group's lanes meet, a column per lane.
template <std::uint32_t Capacity>
struct LeafColumns {
    static constexpr std::uint32_t capacity = Capacity;  ///< nodes of a column

    MetLeaves met[Capacity][LaneGroup::width];  ///< met[k][lane]: the k-th node of that lane
};

namespace detail {

/// Children of a node that are still to be visited. Aligned so that the device moves it as one
/// word.
struct alignas(8) WaitingChildren {
    std::uint32_t first_node;  ///< NodeLinks::first_node of their parent
    std::uint32_t slots;  ///< a bit for each that waits; above them one for each that is a node

    [[nodiscard]] MIR_HD static WaitingChildren of(std::uint32_t first_node, std::uint32_t inner,
                                                   std::uint32_t waiting) {
        return {first_node, inner << WideNode::width | waiting};
    }
    [[nodiscard]] MIR_HD bool empty() const {
        return (slots & ((1u << WideNode::width) - 1u)) == 0;
    }
    MIR_HD std::uint32_t pop() {
        const std::uint32_t k = LaneGroup::lowest(slots);
        slots &= slots - 1;
        return NodeLinks::node(first_node, slots >> WideNode::width, k);
    }
};

}  // namespace detail

/// What a lane's search comes back to. Apart from it, because the device keeps what lies beside an
/// array that is looked up by number in memory, too. Without defaults, which would clear all of it
/// for every shaft.
struct LeafStack {
    detail::WaitingChildren entries[WideBvhOptions::depth_limit];  ///< the first `waiting` count
};

/// How far the search of one lane has come.
enum class LeafSearchState : std::uint8_t {
    off,       ///< there was nothing to look for
    running,   ///< nodes are left
    complete,  ///< every leaf that the shaft meets is listed
    given_up   ///< there were too many nodes
};

/// A lane's walk of its shaft through a wide hierarchy, a node per step. Leaves are listed without
/// a look at their triangles: lanes that test triangles in between lose step.
struct LeafSearch {
    LeafSearchState state;        ///< begin() sets it
    std::uint32_t listed;         ///< nodes with leaves that the shaft meets
    std::uint32_t visited;        ///< nodes
    std::uint32_t node;           ///< visited next
    detail::WaitingChildren top;  ///< visited after it, before those of the stack; may be empty
    std::uint32_t waiting;        ///< entries of the stack

    /// Starts at the root, or does nothing where `on` is false. Before it no member has a value.
    MIR_HD void begin(bool on) {
        state = on ? LeafSearchState::running : LeafSearchState::off;
        listed = visited = waiting = node = 0;
        top = {0, 0};
    }
    /// Puts children before those that wait.
    MIR_HD void push(detail::WaitingChildren children, LeafStack& stack) {
        if (!top.empty()) stack.entries[waiting++] = top;
        top = children;
    }
    /// Goes to the next node; false when none waits.
    MIR_HD bool next(const LeafStack& stack) {
        if (top.empty() && waiting > 0) top = stack.entries[--waiting];
        if (top.empty()) return false;
        node = top.pop();
        return true;
    }
    /// True while nodes are left and there were not too many.
    [[nodiscard]] MIR_HD bool is_running() const { return state == LeafSearchState::running; }
};

namespace detail {

/// One node.
template <Space S, std::uint32_t Capacity>
MIR_HD void step(const QuantisedBvhView<S>& bvh, const ShaftSlabs& slabs, std::uint32_t most_nodes,
                 std::uint32_t lane, LeafSearch& search, LeafStack& stack,
                 LeafColumns<Capacity>& columns) {
    const QuantisedNode node = bvh.boxes[search.node];
    const std::uint32_t met = met_slots(node, slabs);
    const std::uint32_t inner = met & node.inner;
    const std::uint32_t leaf = met ^ inner;
    bool over = false;
    if (leaf != 0) {
        over = search.listed == Capacity || search.node >= MetLeaves::most_nodes;
        if (!over) columns.met[search.listed++][lane] = MetLeaves::of(search.node, leaf);
    }
    if (inner != 0) {
        const std::uint32_t first_node = bvh.links[search.node].first_node;
        search.push(WaitingChildren::of(first_node, node.inner, inner), stack);
    }
    const bool ended = !search.next(stack);
    over = over || (!ended && ++search.visited >= most_nodes);
    if (ended) search.state = LeafSearchState::complete;
    if (over) search.state = LeafSearchState::given_up;
}

}  // namespace detail

/// The lanes whose searches have nodes left.
[[nodiscard]] MIR_HD inline std::uint32_t running_lanes(
    const LaneGroup& group, const LaneGroup::PerLane<LeafSearch>& searches) {
    return group.ballot([&](std::uint32_t lane) { return searches[lane].is_running(); });
}

/// A node for each lane that has one left, within `most_nodes` of its search. Where one is
/// complete, and cluster and VPL lie within reach, the lane's column holds every triangle that
/// hits_segment() accepts for some segment of its shaft. Lanes that met a leaf or went up come
/// together again before the next.
template <Space S, std::uint32_t Capacity>
MIR_HD void visit_nodes(const LaneGroup& group, const QuantisedBvhView<S>& bvh,
                        const LaneGroup::PerLane<ShaftSlabs>& slabs, std::uint32_t most_nodes,
                        LaneGroup::PerLane<LeafSearch>& searches,
                        LaneGroup::PerLane<LeafStack>& stacks, LeafColumns<Capacity>& columns) {
    group.each([&](std::uint32_t lane) {
        if (searches[lane].is_running())
            detail::step(bvh, slabs[lane], most_nodes, lane, searches[lane], stacks[lane], columns);
    });
}

}  // namespace mir
