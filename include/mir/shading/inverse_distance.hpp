// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rounding.hpp"

namespace mir {

/// 1 / d, m^-1, of the way from a luxel to a VPL, metres; those nearer than 2^-50 m count as so far
/// apart. Same bits on host and device up to 2^63 m: squares of larger distances are no floats, of
/// which a device makes NaN.
template <class Rounding>
[[gnu::always_inline]] MIR_HD inline float inverse_distance(Vec3 way) {
    const float squared = larger(dot<Rounding>(way, way), 0x1p-100f);
    return strict::usual_reciprocal(strict::usual_sqrt(squared));
}

}  // namespace mir
