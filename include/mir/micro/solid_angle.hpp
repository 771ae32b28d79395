// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mir {

/// Solid angle of a sphere of radius r at distance d > r, sr. 2 pi (1 - sqrt(1 - s)) with s = (r /
/// d)^2, 0 to 1, written without a difference of nearly equal numbers; relative error below 4 *
/// 2^-24. Never below pi s, the usual estimate, and twice that at s = 1.
[[nodiscard]] MIR_HD inline float cap_solid_angle(float s) {
    return 2.0f * pi * s / (1.0f + sqrtf(larger(0.0f, 1.0f - s)));
}

/// The s = (r / d)^2 of a sphere with that solid angle. 1 from a hemisphere on, 0 for none. Spheres
/// are compared with a solid angle by it, without a root for each. Relative error below 4 * 2^-24.
[[nodiscard]] MIR_HD inline float cap_sine_squared(float solid_angle) {
    const float share = smaller(solid_angle * (0.5f * inv_pi), 1.0f);
    return larger(share * (2.0f - share), 0.0f);
}

}  // namespace mir
