// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/data/luxel.hpp"
#include "mir/micro/surfel_tree_view.hpp"

#include <algorithm>

namespace mir {

/// One side of the discs below a node.
struct SurfelFace {
    SurfelTreeView<Space::host> tree;  ///< that holds the discs
    std::uint32_t node = 0;            ///< above the discs, or a leaf
    bool front = true;                 ///< the side of the normals, or that against them
    float ray_offset = 0.0f;           ///< WorldGeometry::ray_offset(), metres

    /// The place that a point of the unit square picks, and the normal there. Uniform by area,
    /// lifted off the disc, and off the edges of its piece by a thousandth, where walls may meet at
    /// sharp angles. The centre of whole discs. Points with nearly the same first coordinate pick
    /// discs near each other.
    [[nodiscard]] Hit place(Vec2 u) const {
        std::uint32_t index = node;
        while (!tree.nodes[index].is_leaf()) {
            const std::uint32_t right = tree.nodes[index].right;
            const float share = tree.area[right] / (tree.area[index + 1] + tree.area[right]);
            const bool is_right = u.x < share;
            u.x = std::min(is_right ? u.x / share : (u.x - share) / (1.0f - share), below_one);
            index = is_right ? right : index + 1;
        }
        return place_on(index, u);
    }

 private:
    static constexpr float below_one = 0x1.fffffep-1f;

    [[nodiscard]] Hit place_on(std::uint32_t leaf, Vec2 u) const {
        const SurfelNode& disc = tree.nodes[leaf];
        const Surfel& piece = tree.surfels[disc.first];
        const float root = sqrtf(u.x);
        const float second = root * u.y;
        const Vec3 corner0 = -(piece.corner1 + piece.corner2);
        const Vec3 off =
            (1.0f - root) * corner0 + (root - second) * piece.corner1 + second * piece.corner2;
        const Vec3 normal = front ? disc.axis : -disc.axis;
        const float offset = larger(least_offset(disc.centre), ray_offset);
        return {lift(disc.centre, normal, offset) + 0.999f * off, normal};
    }
};

}  // namespace mir
