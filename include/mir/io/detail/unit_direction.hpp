// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cmath>

namespace mir::detail {

/// `v` with length 1. What is unit to rounding stays as it is, so that files written by
/// write_glb come back unchanged. Zero when `v` is no direction.
inline Vec3 unit_direction(Vec3 v) {
    const float squared = length_squared(v);
    if (std::fabs(squared - 1.0f) < 1e-6f) return v;
    if (!(squared > 0.0f) || !std::isfinite(squared)) return Vec3(0.0f);
    return v / std::sqrt(squared);
}

}  // namespace mir::detail
