// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>

namespace mir {

/// A disc that stands for a piece of a triangle. Around the centroid of the piece, in the plane of
/// the triangle, and no larger than the piece where that is known. A trivially copyable value of 64
/// bytes.
struct alignas(16) Surfel {
    /// What discs belong to that were not made from a triangle.
    static constexpr std::uint32_t no_triangle = 0xFFFFFFFFu;

    Vec3 position{0};            ///< centre, metres
    float radius = 0.0f;         ///< metres; SurfelOptions::extent says which
    Vec3 normal{0, 0, 1};        ///< unit, of the triangle's front
    float area = 0.0f;           ///< of the piece, m^2
    std::uint32_t triangle = 0;  ///< index into WorldGeometry, or no_triangle
    std::uint32_t material = 0;  ///< index into Scene::materials
    /// From the centre to two corners of the piece, counter-clockwise around the normal. The third
    /// is minus their sum. Both zero: the disc is whole. Metres.
    Vec3 corner1{0};
    Vec3 corner2{0};  ///< like corner1

    /// True when nothing is cut off.
    [[nodiscard]] MIR_HD bool is_whole() const {
        return corner1 == Vec3(0.0f) && corner2 == Vec3(0.0f);
    }

    /// True when a point of the plane is inside the piece, up to `margin`. The point is `off` away
    /// from the centre, at most `margin` metres outside of each edge.
    [[nodiscard]] MIR_HD bool in_piece(Vec3 off, float margin) const {
        const Vec3 corner0 = -(corner1 + corner2);
        return left_of(corner0, corner1, off, margin) && left_of(corner1, corner2, off, margin) &&
               left_of(corner2, corner0, off, margin);
    }

 private:
    [[nodiscard]] MIR_HD bool left_of(Vec3 a, Vec3 b, Vec3 p, float margin) const {
        const Vec3 edge = b - a;
        const float across = glm::dot(normal, glm::cross(edge, p - a));
        return across >= 0.0f || across * across <= margin * margin * length_squared(edge);
    }
};

static_assert(sizeof(Surfel) == 64);

}  // namespace mir
