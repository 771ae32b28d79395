// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mir {

/// A sphere seen from a point.
struct SeenSphere {
    Vec3 direction{0, 0, 1};  ///< unit, of its centre
    float sine = 1.0f;        ///< of the angle from there to its rim; 1 or more: around the point

    /// `to_centre` leads from the point to the centre, metres, like `radius`.
    MIR_HD SeenSphere(Vec3 to_centre, float radius) {
        const float distance = glm::length(to_centre);
        if (!(radius < distance)) return;
        const float share = 1.0f / distance;
        direction = share * to_centre;
        sine = share * radius;
    }

    /// True when the point lies inside: every direction may meet the sphere.
    [[nodiscard]] MIR_HD bool is_around() const { return !(sine < 1.0f); }
    /// Of the same angle; 0 around the point.
    [[nodiscard]] MIR_HD float cosine() const { return sqrtf(larger(0.0f, 1.0f - sine * sine)); }
};

/// A rectangle of the unit square of a micro-buffer's texels, all of it unless said. On axes that
/// go around it may reach past 0 or 1.
struct TexelReach {
    Vec2 low{0.0f};   ///< least u and v
    Vec2 high{1.0f};  ///< largest u and v

    /// No direction at all.
    [[nodiscard]] MIR_HD static TexelReach none() { return {Vec2(1.0f), Vec2(0.0f)}; }
};

}  // namespace mir
