// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/unit_circle.hpp"

namespace mir {

// Area-preserving maps from the unit square, with their densities. Directions are in a local frame
// whose normal is +z; directional densities are per steradian, the others per unit area.

/// Unit disc, concentric map of Shirley and Chiu (1997). Density 1/pi.
MIR_HD inline Vec2 square_to_disc(Vec2 u) {
    const float a = 2.0f * u.x - 1.0f;
    const float b = 2.0f * u.y - 1.0f;
    if (a == 0.0f && b == 0.0f) return {0.0f, 0.0f};
    const bool wide = fabsf(a) > fabsf(b);
    const float r = wide ? a : b;
    const float turns = wide ? 0.125f * (b / a) : 0.25f - 0.125f * (a / b);
    return r * unit_circle(turns);
}

/// Upper hemisphere with density cos(theta)/pi (Malley's method).
MIR_HD inline Vec3 square_to_cosine_hemisphere(Vec2 u) {
    const Vec2 d = square_to_disc(u);
    return {d.x, d.y, sqrtf(larger(0.0f, 1.0f - d.x * d.x - d.y * d.y))};
}
/// Its density, per steradian.
MIR_HD inline float cosine_hemisphere_pdf(float cos_theta) {
    return cos_theta > 0.0f ? cos_theta * inv_pi : 0.0f;
}

/// Whole sphere of directions, density 1/(4 pi).
MIR_HD inline Vec3 square_to_sphere(Vec2 u) {
    const float z = 1.0f - 2.0f * u.x;
    const float r = sqrtf(larger(0.0f, 1.0f - z * z));
    return {r * unit_circle(u.y), z};
}
/// Its density, per steradian.
MIR_HD inline float sphere_pdf() { return 0.25f * inv_pi; }

/// Cone around +z of half angle acos(cos_max), uniform in solid angle.
MIR_HD inline Vec3 square_to_cone(Vec2 u, float cos_max) {
    const float z = 1.0f - u.x * (1.0f - cos_max);
    const float r = sqrtf(larger(0.0f, 1.0f - z * z));
    return {r * unit_circle(u.y), z};
}
/// Its density, per steradian.
MIR_HD inline float cone_pdf(float cos_max) { return 1.0f / (2.0f * pi * (1.0f - cos_max)); }

/// Uniform barycentric coordinates (of the second and third vertex) of a triangle. The density is
/// one over its area. Folding keeps the map continuous almost everywhere and needs no square root.
MIR_HD inline Vec2 square_to_triangle(Vec2 u) {
    if (u.x + u.y > 1.0f) return {1.0f - u.x, 1.0f - u.y};
    return u;
}

}  // namespace mir
