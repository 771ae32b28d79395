// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rounding.hpp"
#include "mir/data/vpl.hpp"

namespace mir {

/// 1 / d of a luxel at a place, metres, and a VPL, m^-1; infinite where they touch. Same bits on
/// host and device.
template <class Rounding>
[[gnu::always_inline]] MIR_HD inline float inverse_distance(Vec3 luxel, const Vpl& vpl) {
    const Vec3 d = vpl.position - luxel;
    return strict::reciprocal_of_root(dot<Rounding>(d, d));
}

}  // namespace mir
