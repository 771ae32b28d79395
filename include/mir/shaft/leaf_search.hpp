// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/quantised_bvh.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/shaft/pair_search.hpp"
#include "mir/shaft/shaft_slabs.hpp"

namespace mir {

/// Leaves of one node of a wide hierarchy, in one word: the node and a bit for each slot. Empty
/// slots may be among them.
struct MetLeaves {
    static constexpr std::uint32_t most_nodes = 1u << 24;  ///< nodes with larger numbers do not fit

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

/// Children of a node that are still to be visited. Without defaults, which would clear the whole
/// stack for every shaft.
struct WaitingChildren {
    std::uint32_t node;   ///< their parent
    std::uint32_t slots;  ///< a bit for each that waits; above them one for each that is a node

    [[nodiscard]] MIR_HD static WaitingChildren of(std::uint32_t node, std::uint32_t inner,
                                                   std::uint32_t waiting) {
        return {node, inner << WideNode::width | waiting};
    }
    [[nodiscard]] MIR_HD bool empty() const {
        return (slots & ((1u << WideNode::width) - 1u)) == 0;
    }
    MIR_HD std::uint32_t pop(const NodeLinks* links) {
        const std::uint32_t k = LaneGroup::lowest(slots);
        slots &= slots - 1;
        return NodeLinks::node(links[node].first_node, slots >> WideNode::width, k);
    }
};

}  // namespace detail

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
    LeafSearchState state;  ///< begin() sets it
    std::uint32_t listed;   ///< nodes with leaves that the shaft meets
    std::uint32_t visited;  ///< nodes
    std::uint32_t node;     ///< visited next
    std::uint32_t waiting;  ///< nodes on the stack
    detail::WaitingChildren stack[WideBvhOptions::depth_limit];  ///< of the way down

    /// Starts at the root, or does nothing where `on` is false. Before it no member has a value.
    MIR_HD void begin(bool on) {
        state = on ? LeafSearchState::running : LeafSearchState::off;
        listed = visited = waiting = node = 0;
    }
    /// True while nodes are left and there were not too many.
    [[nodiscard]] MIR_HD bool is_running() const { return state == LeafSearchState::running; }
};

namespace detail {

/// One node.
template <Space S, std::uint32_t Capacity>
MIR_HD void step(const QuantisedBvhView<S>& bvh, const ShaftSlabs& slabs, std::uint32_t most_nodes,
                 std::uint32_t lane, LeafSearch& search, LeafColumns<Capacity>& columns) {
    const QuantisedNode node = bvh.boxes[search.node];
    const std::uint32_t met = met_slots(node, slabs);
    const std::uint32_t inner = met & node.inner;
    const std::uint32_t leaf = met ^ inner;
    bool over = false;
    if (leaf != 0) {
        over = search.listed == Capacity || search.node >= MetLeaves::most_nodes;
        if (!over) columns.met[search.listed++][lane] = MetLeaves::of(search.node, leaf);
    }
    if (inner != 0)
        search.stack[search.waiting++] = WaitingChildren::of(search.node, node.inner, inner);
    const bool ended = search.waiting == 0;
    over = over || (!ended && ++search.visited >= most_nodes);
    if (!ended) {
        WaitingChildren& top = search.stack[search.waiting - 1];
        search.node = top.pop(bvh.links);
        if (top.empty()) --search.waiting;
    }
    if (ended) search.state = LeafSearchState::complete;
    if (over) search.state = LeafSearchState::given_up;
}

}  // namespace detail

/// Runs the searches of all lanes to their ends, each within `most_nodes` nodes. Where one is
/// complete, and cluster and VPL lie within reach, the lane's column holds every triangle that
/// hits_segment() accepts for some segment of its shaft. A node per turn for all lanes that have
/// one left: lanes that met a leaf or went up come together again before the next.
template <Space S, std::uint32_t Capacity>
MIR_HD void search_leaves(const LaneGroup& group, const QuantisedBvhView<S>& bvh,
                          const LaneGroup::PerLane<ShaftSlabs>& slabs, std::uint32_t most_nodes,
                          LaneGroup::PerLane<LeafSearch>& searches,
                          LeafColumns<Capacity>& columns) {
    while (group.ballot([&](std::uint32_t lane) { return searches[lane].is_running(); }) != 0)
        group.each([&](std::uint32_t lane) {
            if (searches[lane].is_running())
                detail::step(bvh, slabs[lane], most_nodes, lane, searches[lane], columns);
        });
}

}  // namespace mir
