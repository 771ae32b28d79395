// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstdint>

namespace mir {

/// What a VPL of intensity 1 W sr^-1 in each channel does to an image.
struct ImageResponse {
    double r = 0.0;                ///< t_v: mean radiance over all luxels, W m^-2 sr^-1 per W sr^-1
    double g = 0.0;                ///< green, as r
    double b = 0.0;                ///< blue, as r
    std::uint64_t lit_luxels = 0;  ///< luxels that see the VPL and reflect something

    /// Adds what the VPL does to other luxels. Many sums keep their bits only in a fixed order.
    MIR_HD ImageResponse& operator+=(const ImageResponse& o) {
        r += o.r;
        g += o.g;
        b += o.b;
        lit_luxels += o.lit_luxels;
        return *this;
    }
};

}  // namespace mir
