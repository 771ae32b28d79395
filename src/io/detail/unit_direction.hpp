// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cmath>

namespace mir::detail {

inline Vec3 times_power_of_two(Vec3 v, int exponent) {
    return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}

/// The power of two that brings `v`'s length between 0.7 and 1.5. It has a length. Multiplying by
/// it rounds nothing: a unit vector below a node of scale 2^k comes back in every bit, and no
/// square of what is left vanishes or overflows.
inline int exponent_to_unit(Vec3 v) {
    int exponent = 0;
    static_cast<void>(std::frexp(max_abs(v), &exponent));
    const float squared = length_squared(times_power_of_two(v, -exponent));
    if (squared < 0.5f) --exponent;
    if (squared >= 2.0f) ++exponent;
    return -exponent;
}

/// `v` with length 1. What is unit to rounding, or a power of two times that, keeps its digits, so
/// that files written by write_glb come back unchanged. Zero when `v` is no direction.
inline Vec3 unit_direction(Vec3 v) {
    if (!is_finite(v) || v == Vec3(0.0f)) return Vec3(0.0f);
    const Vec3 near = times_power_of_two(v, exponent_to_unit(v));
    const float squared = length_squared(near);
    return std::fabs(squared - 1.0f) < 1e-6f ? near : near / std::sqrt(squared);
}

}  // namespace mir::detail
