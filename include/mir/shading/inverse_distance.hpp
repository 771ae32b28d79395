// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/strict_float.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/vpl.hpp"

namespace mir {

/// 1 / d of a luxel and a VPL, m^-1; infinite where they touch. Same bits on host and device.
[[gnu::always_inline]] MIR_HD inline float inverse_distance(const Hit& hit, const Vpl& vpl) {
    return strict::reciprocal_of_root(length_squared(vpl.position - hit.position));
}

}  // namespace mir
