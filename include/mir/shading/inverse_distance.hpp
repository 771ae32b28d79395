// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rounding.hpp"

namespace mir {

/// 1 / d, m^-1, of the offset from a luxel to a VPL, metres. Offsets shorter than 2^-50 m count as
/// that long. Same bits on host and device up to 2^50 m. From 2^64 m on squares are no floats, and
/// a device gives NaN.
template <class Rounding>
[[gnu::always_inline]] MIR_HD inline float inverse_distance(Vec3 offset) {
    const float squared = larger(dot<Rounding>(offset, offset), 0x1p-100f);
    return strict::usual_reciprocal(strict::usual_sqrt(squared));
}

}  // namespace mir
