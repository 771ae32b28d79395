// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/unit_circle.hpp"

namespace mir {

/// The directions in which a point sees a sphere. Those within asin(sine) of the unit vector
/// `axis`. Precise for the smallest of them too, where 1 - cos of the angle has no digits.
struct SphereCone {
    Vec3 axis{0, 0, 1};  ///< unit
    float sine = 0.0f;   ///< radius over distance, (0, 1]; 1: a hemisphere

    /// Cosine of the half angle.
    [[nodiscard]] MIR_HD float cosine() const { return sqrtf((1.0f - sine) * (1.0f + sine)); }
    /// 1 - cosine().
    [[nodiscard]] MIR_HD float height() const { return sine * sine / (1.0f + cosine()); }

    /// Uniform in solid angle, in a frame with the axis along +z.
    [[nodiscard]] MIR_HD Vec3 direction(Vec2 u) const {
        const float h = u.x * height();
        return {sqrtf(h * (2.0f - h)) * unit_circle(u.y), 1.0f - h};
    }
    /// Density of direction(), per steradian.
    [[nodiscard]] MIR_HD float pdf() const { return 1.0f / (2.0f * pi * height()); }

    /// True for unit vectors inside.
    [[nodiscard]] MIR_HD bool contains(Vec3 w) const {
        return glm::dot(w, axis) > 0.0f && length_squared(glm::cross(w, axis)) <= sine * sine;
    }

    /// int (w.a) (w.b) dw over the cone for unit vectors a and b. From axis.a, axis.b and a.b. With
    /// c the cosine, int w w^T dw is 2 pi (1 - c^3) / 3 along the axis and pi (1 - c)^2 (2 + c) / 3
    /// across.
    [[nodiscard]] MIR_HD float cosine_product(float axis_a, float axis_b, float a_b) const {
        const float c = cosine();
        const float h = height();
        const float along = 2.0f * h * (1.0f + c + c * c);
        const float across = h * h * (2.0f + c);
        return pi / 3.0f * (along * axis_a * axis_b + across * (a_b - axis_a * axis_b));
    }
};

}  // namespace mir
