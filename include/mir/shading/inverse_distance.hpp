// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rounding.hpp"
#include "mir/data/vpl.hpp"

namespace mir {

/// 1 / d of a luxel at a place, metres, and a VPL, m^-1; places nearer than 2^-50 m count as so far
/// apart. Same bits on host and device up to 2^63 m: squares of larger distances are no floats, of
/// which a device makes NaN.
template <class Rounding>
[[gnu::always_inline]] MIR_HD inline float inverse_distance(Vec3 luxel, const Vpl& vpl) {
    const Vec3 d = vpl.position - luxel;
    const float squared = larger(dot<Rounding>(d, d), 0x1p-100f);
    return strict::usual_reciprocal(strict::usual_sqrt(squared));
}

}  // namespace mir
