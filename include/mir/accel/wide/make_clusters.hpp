// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/cluster.hpp"
#include "mir/accel/wide/detail/slot_costs.hpp"
#include "mir/accel/wide/split_triangles.hpp"
#include "mir/core/morton.hpp"

namespace mir::detail {

/// Kernel over triangles. Boxes around their accept regions, or around the parts of these, and the
/// places of the boxes along Morton's curve through the scene's bounds.
template <Space S>
struct MakeBoxes {
    GeometryView<S> geometry;
    ClusterPlan plan;
    SplitCounts splits;
    const std::uint32_t* first = nullptr;  ///< reference, by triangle; nullptr: none is split
    Cluster* boxes = nullptr;              ///< by reference
    std::uint64_t* keys = nullptr;         ///< by reference
    std::uint32_t* values = nullptr;       ///< the reference

    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t at = first == nullptr ? i : first[i];
        const std::uint32_t count = first == nullptr ? 0 : splits.of(i);
        if (count == 0) {
            write(at, i,
                  accept_box(geometry.corner(i, 0), geometry.corner(i, 1), geometry.corner(i, 2),
                             plan.magnitude));
            return;
        }
        const MakeBoxes& self = *this;
        cut_into_parts(whole_triangle(geometry, i, plan.magnitude), count, plan.planes,
                       [&self, at, i](std::uint32_t k, const PartBox& part) {
                           self.write(at + k, i,
                                      grown(part, accept_margin_of(self.plan.magnitude)));
                       });
    }

 private:
    MIR_HD void write(std::uint32_t at, std::uint32_t triangle, const Bounds& box) const {
        boxes[at] = {box.low, triangle, box.high, 0};
        keys[at] = fine_morton_code({place(box.low.x, box.high.x, plan.low.x),
                                     place(box.low.y, box.high.y, plan.low.y),
                                     place(box.low.z, box.high.z, plan.low.z)});
        values[at] = at;
    }
    [[nodiscard]] MIR_HD float place(float low, float high, float scene_low) const {
        const float centre = strict::mul(0.5f, strict::add(low, high));
        return strict::mul(strict::sub(centre, scene_low), plan.to_unit);
    }
};

/// Kernel over places along the curve: makes a leaf and a cluster of each.
struct PlaceLeaves {
    const Cluster* boxes = nullptr;             ///< by reference
    const std::uint32_t* references = nullptr;  ///< by place
    BinaryNode* nodes = nullptr;
    SlotCosts* costs = nullptr;
    Cluster* clusters = nullptr;
    CostRule rule;

    MIR_HD void operator()(std::uint32_t i) const {
        const Cluster box = boxes[references[i]];
        nodes[i] = {box.low, box.high, box.node, 0, 1, 0};
        costs[i] = triangle_costs(rule.area(box.low, box.high));
        clusters[i] = {box.low, i, box.high, 0};
    }
};

}  // namespace mir::detail
