// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/cluster.hpp"
#include "mir/accel/detail/cluster_plan.hpp"
#include "mir/accel/detail/slot_costs.hpp"
#include "mir/core/morton.hpp"

namespace mir::detail {

/// Kernel over triangles: their accept boxes, and the places of these along Morton's curve through
/// the scene's bounds.
template <Space S>
struct MakeBoxes {
    GeometryView<S> geometry;
    ClusterPlan plan;
    Cluster* boxes = nullptr;         ///< by triangle
    std::uint64_t* keys = nullptr;    ///< by triangle
    std::uint32_t* values = nullptr;  ///< the triangle

    MIR_HD void operator()(std::uint32_t i) const {
        const Bounds box = accept_box(geometry.corner(i, 0), geometry.corner(i, 1),
                                      geometry.corner(i, 2), plan.magnitude);
        boxes[i] = {box.low, i, box.high, 0};
        keys[i] = fine_morton_code({place(box.low.x, box.high.x, plan.low.x),
                                    place(box.low.y, box.high.y, plan.low.y),
                                    place(box.low.z, box.high.z, plan.low.z)});
        values[i] = i;
    }

 private:
    [[nodiscard]] MIR_HD float place(float low, float high, float scene_low) const {
        const float centre = strict::mul(0.5f, strict::add(low, high));
        return strict::mul(strict::sub(centre, scene_low), plan.to_unit);
    }
};

/// Kernel over places along the curve: a leaf of the binary tree and a cluster of its own for each.
struct PlaceLeaves {
    const Cluster* boxes = nullptr;            ///< by triangle
    const std::uint32_t* triangles = nullptr;  ///< by place
    BinaryNode* nodes = nullptr;
    SlotCosts* costs = nullptr;
    Cluster* clusters = nullptr;
    CostRule rule;

    MIR_HD void operator()(std::uint32_t i) const {
        const Cluster box = boxes[triangles[i]];
        nodes[i] = {box.low, box.high, box.node, 0, 1, 0};
        costs[i] = triangle_costs(rule.area(box.low, box.high));
        clusters[i] = {box.low, i, box.high, 0};
    }
};

}  // namespace mir::detail
