// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

namespace mir {

/// A direction drawn from a BSDF.
struct BsdfSample {
    Vec3 wi{0};        ///< unit direction
    Rgb weight;        ///< f cos(theta) / pdf; black when the sample is to be thrown away
    float pdf = 0.0f;  ///< per steradian, of every way in which sample() can yield wi
};

}  // namespace mir
