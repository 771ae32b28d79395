// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh_view.hpp"
#include "mir/shaft/exact/shaft.hpp"

namespace mir {

/// How a walk came to its end.
enum class WalkEnd : std::uint8_t {
    complete,  ///< every leaf that the shaft meets was shown
    stopped,   ///< the visitor wanted no more
    given_up   ///< there were more nodes than allowed
};

namespace detail {

/// Slots of a node whose boxes the shaft meets, bit k for slot k. What it says of empty slots means
/// nothing.
MIR_HD inline std::uint32_t met_slots(const WideNode& node, const Shaft& shaft) {
    std::uint32_t mask = 0;
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        const Vec3 low(node.low(0, k), node.low(1, k), node.low(2, k));
        const Vec3 high(node.high(0, k), node.high(1, k), node.high(2, k));
        mask |= meets_box(shaft, low, high) ? 1u << k : 0u;
    }
    return mask;
}

/// A node and its inner children that are still to be visited. Without defaults, which would clear
/// the whole stack for every shaft.
struct WaitingSlots {
    std::uint32_t node;
    std::uint32_t slots;
};

/// Shows the leaves among `met` to the visitor and removes them. True when it wants no more.
template <class Leaf>
MIR_HD bool visit_leaves(const WideNode& node, Leaf& leaf, std::uint32_t& met) {
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        if ((met >> k & 1u) == 0 || node.is_inner(k)) continue;
        met ^= 1u << k;
        if (node.is_leaf(k) && leaf(node.ref[k], static_cast<std::uint32_t>(node.count[k])))
            return true;
    }
    return false;
}

/// Takes the lowest slot.
MIR_HD inline std::uint32_t pop_slot(std::uint32_t& slots) {
    std::uint32_t k = 0;
    while ((slots >> k & 1u) == 0) ++k;
    slots ^= 1u << k;
    return k;
}

}  // namespace detail

/// Calls `leaf(first, count)` for the leaves that a shaft meets. It ends when one call returns true
/// or more than `most_nodes` nodes would be visited. If the walk is complete, and cluster and VPL
/// lie within reach, those leaves hold all triangles that hits_segment() accepts for some segment
/// of the shaft. A node is on the stack only while one of its children is visited, so that the
/// stack holds nodes of one path alone.
template <Space S, class Leaf>
[[nodiscard]] MIR_HD WalkEnd walk_shaft(const WideBvhView<S>& bvh, const Shaft& shaft,
                                        std::uint32_t most_nodes, Leaf& leaf) {
    detail::WaitingSlots stack[WideBvhView<S>::max_depth];
    std::uint32_t waiting = 0;
    std::uint32_t node = WideBvhView<S>::root;
    for (std::uint32_t visited = 0; visited < most_nodes; ++visited) {
        std::uint32_t inner = detail::met_slots(bvh.nodes[node], shaft);
        if (detail::visit_leaves(bvh.nodes[node], leaf, inner)) return WalkEnd::stopped;
        if (inner != 0) stack[waiting++] = {node, inner};
        if (waiting == 0) return WalkEnd::complete;
        detail::WaitingSlots& top = stack[waiting - 1];
        node = bvh.nodes[top.node].ref[detail::pop_slot(top.slots)];
        if (top.slots == 0) --waiting;
    }
    return WalkEnd::given_up;
}

}  // namespace mir
