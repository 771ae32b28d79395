// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/rgb.hpp"

#include <algorithm>
#include <cmath>

namespace mir::detail {

// Colour spaces of FLIP. XYZ is always relative to the white point, so that white is (1, 1, 1): the
// formulas of YCxCz and CIELAB ask for nothing else.

/// Linear Rec. 709 to relative XYZ: primaries of Rec. 709, white D65 at (0.3127, 0.3290).
inline Vec3 xyz_of(Rgb c) {
    const Vec3 rgb(c.r, c.g, c.b);
    return {glm::dot(Vec3(0.433887346f, 0.376224009f, 0.189888645f), rgb),
            glm::dot(Vec3(0.212639006f, 0.715168679f, 0.072192315f), rgb),
            glm::dot(Vec3(0.017750040f, 0.109447621f, 0.872802339f), rgb)};
}

/// Inverse of xyz_of().
inline Rgb rgb_of_xyz(Vec3 xyz) {
    return {glm::dot(Vec3(3.080399091f, -1.537383178f, -0.543015913f), xyz),
            glm::dot(Vec3(-0.921223359f, 1.875967502f, 0.045255857f), xyz),
            glm::dot(Vec3(0.052873939f, -0.203976959f, 1.151103020f), xyz)};
}

/// L*, a*, b* or Y, Cx, Cz from the numbers made of X, Y, Z. CIELAB and YCxCz each make three.
inline Vec3 opponent_of(Vec3 f) {
    return {116.0f * f.y - 16.0f, 500.0f * (f.x - f.y), 200.0f * (f.y - f.z)};
}

/// The linearised opponent space YCxCz, in which the eye's contrast sensitivity is measured.
inline Vec3 ycxcz_of(Rgb c) { return opponent_of(xyz_of(c)); }

/// Inverse of ycxcz_of().
inline Rgb rgb_of_ycxcz(Vec3 c) {
    const float y = (c.x + 16.0f) / 116.0f;
    return rgb_of_xyz({y + c.y / 500.0f, y, y - c.z / 200.0f});
}

/// CIELAB's compression of one relative tristimulus value.
inline float lab_curve(float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}

/// CIELAB with the Hunt effect: colours seem less colourful the darker they are.
inline Vec3 hunt_lab_of(Rgb c) {
    const Vec3 xyz = xyz_of(c);
    const Vec3 lab = opponent_of({lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z)});
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

/// Distance for large colour differences. City block in lightness, Euclidean in chroma (Abasi,
/// Amani Tehran and Fairchild, "Distance metrics for very large color differences", 2020).
inline float hyab(Vec3 a, Vec3 b) {
    const Vec3 d = a - b;
    return std::fabs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

}  // namespace mir::detail
