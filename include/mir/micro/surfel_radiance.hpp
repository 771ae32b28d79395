// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/ray.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/luxel.hpp"
#include "mir/micro/surfel_tree.hpp"
#include "mir/shading/lambert.hpp"

#include <vector>

namespace mir {

/// Light that leaves the two sides of a disc, or on average those of the discs below a node:
/// radiance, W m^-2 sr^-1, the same in all directions.
struct SurfelRadiance {
    Rgb front;  ///< on the side of the normals
    Rgb back;   ///< against the normals

    /// Of the side that is asked for.
    [[nodiscard]] MIR_HD Rgb of(bool front_side) const { return front_side ? front : back; }
};

/// One side of a disc as a luxel: its lifted centre, seen head-on, with the disc's albedo as
/// Lambertian reflectance.
struct SurfelFace {
    Hit hit;                           ///< place of the centre, and normal of the side
    Surface<Lambert::Params> surface;  ///< Lambertian, without emission
    Vec3 corner1{0};                   ///< Surfel::corner1, metres
    Vec3 corner2{0};                   ///< Surfel::corner2, metres

    /// The point of the piece that a point of the unit square picks: uniform by area, lifted as the
    /// centre is, and off the edges by a thousandth, where walls may meet at sharp angles. The
    /// centre of whole discs.
    [[nodiscard]] MIR_HD Vec3 place(Vec2 u) const {
        const float root = sqrtf(u.x);
        const float second = root * u.y;
        const Vec3 corner0 = -(corner1 + corner2);
        const Vec3 off = (1.0f - root) * corner0 + (root - second) * corner1 + second * corner2;
        return hit.position + 0.999f * off;
    }
};

/// The side of leaf `index`. `ray_offset` is WorldGeometry::ray_offset(), metres.
template <Space S>
[[nodiscard]] MIR_HD SurfelFace surfel_face(const SurfelTreeView<S>& tree, std::uint32_t index,
                                            bool front, float ray_offset) {
    const SurfelNode& node = tree.nodes[index];
    const Vec3 normal = front ? node.axis : -node.axis;
    const float offset = larger(least_offset(node.centre), ray_offset);
    const Surfel& disc = tree.surfels[node.first];
    return {{lift(node.centre, normal, offset), normal},
            {normal, normal, {}, {tree.albedo[index]}},
            disc.corner1,
            disc.corner2};
}

/// Mean of the light of an inner node's children by area: relative error below 2^-22.
template <Space S>
[[nodiscard]] MIR_HD SurfelRadiance mean_of_children(const SurfelTreeView<S>& tree,
                                                     std::uint32_t index,
                                                     const SurfelRadiance* radiance) {
    const auto mean = [](Rgb a, Rgb b, float share) { return a * (1.0f - share) + b * share; };
    const std::uint32_t right_index = tree.nodes[index].right;
    const float right_area = tree.area[right_index];
    const float share = right_area / (tree.area[index + 1] + right_area);
    const SurfelRadiance& left = radiance[index + 1];
    const SurfelRadiance& right = radiance[right_index];
    return {mean(left.front, right.front, share), mean(left.back, right.back, share)};
}

/// Fills the inner nodes with the means of their children, from the leaves up. `radiance` has an
/// element for each node.
inline void average_radiance(const SurfelTree& tree, std::span<SurfelRadiance> radiance) {
    const SurfelTreeView<Space::host> view = tree.view();
    for (std::uint32_t i = view.node_count; i-- > 0;)
        if (!view.nodes[i].is_leaf()) radiance[i] = mean_of_children(view, i, radiance.data());
}

/// Calls visit(index) for every leaf whose disc is not black, in any order, from any thread.
template <class Visit, Executor E>
void for_each_reflecting_leaf(const SurfelTree& tree, E& executor, const Visit& visit) {
    constexpr std::size_t part = 128;
    const std::size_t nodes = tree.nodes().size();
    executor.for_each((nodes + part - 1) / part, [&](std::size_t p) {
        for (std::size_t i = p * part; i < std::min(nodes, (p + 1) * part); ++i)
            if (tree.nodes()[i].is_leaf() && !is_black(tree.albedo()[i]))
                visit(static_cast<std::uint32_t>(i));
    });
}

/// Lights both sides of every disc. `light(face, number)` is the radiance that leaves a SurfelFace,
/// W m^-2 sr^-1; `number` names it among all sides, for random numbers: twice that of the disc in
/// the order of the tree, plus 1 for its back. Sides whose albedo is black are not asked. Element i
/// belongs to node i. The same for any number of threads.
template <class Light, Executor E>
std::vector<SurfelRadiance> light_surfels(const SurfelTree& tree, const Light& light,
                                          float ray_offset, E& executor) {
    std::vector<SurfelRadiance> radiance(tree.nodes().size());
    const SurfelTreeView<Space::host> view = tree.view();
    for_each_reflecting_leaf(tree, executor, [&](std::uint32_t index) {
        const std::uint64_t number = 2 * std::uint64_t{view.nodes[index].first};
        radiance[index] = {light(surfel_face(view, index, true, ray_offset), number),
                           light(surfel_face(view, index, false, ray_offset), number + 1)};
    });
    average_radiance(tree, radiance);
    return radiance;
}

}  // namespace mir
