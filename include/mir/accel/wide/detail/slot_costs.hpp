// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/binary_node.hpp"
#include "mir/accel/wide/wide_node.hpp"

namespace mir::detail {

// Which nodes of a binary tree to keep as children of wide nodes, for the least expected cost by
// the surface area heuristic. Let C(v, k) be the least cost of all that is below the binary node v
// if it may take k slots of the wide node above: that of a leaf or of a wide node of its own for
// k = 1, else the best way to share the slots between its children, or to leave one empty. What
// fits into a leaf never becomes a node, which costs next to nothing and bounds their height.
// Source: Ylitie, Karras and Laine, "Efficient incoherent ray traversal on GPUs through compressed
// wide BVHs", High Performance Graphics 2017.

/// C(v, k) of one node, in triangle tests times half surfaces.
struct SlotCosts {
    static constexpr std::uint32_t most = WideNode::width - 1;  ///< slots of one side

    float of[most];  ///< k - 1; never ascending

    [[nodiscard]] MIR_HD float with(std::uint32_t slots) const { return of[slots - 1]; }

    /// The fewest slots that cost no more than `slots`.
    [[nodiscard]] MIR_HD std::uint32_t needed(std::uint32_t slots) const {
        std::uint32_t fewest = slots;
        while (fewest > 1 && with(fewest - 1) == with(slots)) --fewest;
        return fewest;
    }
};

/// How the slots of a node are shared.
struct SlotShare {
    std::uint32_t left = 0;  ///< slots of the left child; the others are the right one's
    float cost = 0.0f;
};

/// The best way to share 2 to 8 slots.
MIR_HD inline SlotShare share_slots(const SlotCosts& left, const SlotCosts& right,
                                    std::uint32_t slots) {
    SlotShare best;
    for (std::uint32_t k = 1; k < slots; ++k) {
        const float cost = strict::add(left.with(k), right.with(slots - k));
        if (k == 1 || cost < best.cost) best = {k, cost};
    }
    return best;
}

/// What costs depend on besides areas.
struct CostRule {
    std::uint32_t leaf_size = 0;
    float node_cost = 0.0f;   ///< in triangle tests
    float area_scale = 0.0f;  ///< 1 / metres

    [[nodiscard]] MIR_HD float area(Vec3 low, Vec3 high) const {
        return half_area(low, high, area_scale);
    }
};

/// Of a single triangle.
MIR_HD inline SlotCosts triangle_costs(float area) {
    SlotCosts costs;
    for (float& cost : costs.of) cost = area;
    return costs;
}

/// Of a node with two children, below which there are so many triangles.
MIR_HD inline SlotCosts joined_costs(const SlotCosts& left, const SlotCosts& right, float area,
                                     std::uint32_t triangles, const CostRule& rule) {
    SlotCosts costs;
    costs.of[0] = triangles <= rule.leaf_size
                      ? strict::mul(static_cast<float>(triangles), area)
                      : strict::add(strict::mul(rule.node_cost, area),
                                    share_slots(left, right, WideNode::width).cost);
    for (std::uint32_t k = 2; k <= SlotCosts::most; ++k)
        costs.of[k - 1] = smaller(share_slots(left, right, k).cost, costs.with(k - 1));
    return costs;
}

}  // namespace mir::detail
