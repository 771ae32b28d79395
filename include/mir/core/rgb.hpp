// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mir {

/// Linear Rec. 709 triple. What it measures (radiance, intensity, reflectance) is said where it is
/// used.
struct Rgb {
    float r = 0.0f;  ///< red
    float g = 0.0f;  ///< green
    float b = 0.0f;  ///< blue

    /// Adds channel by channel.
    MIR_HD constexpr Rgb& operator+=(Rgb o) {
        r += o.r;
        g += o.g;
        b += o.b;
        return *this;
    }
    /// Channel by channel.
    friend MIR_HD constexpr Rgb operator+(Rgb a, Rgb o) { return a += o; }
    /// Channel by channel; results may be negative.
    friend MIR_HD constexpr Rgb operator-(Rgb a, Rgb o) {
        return {a.r - o.r, a.g - o.g, a.b - o.b};
    }
    /// Channel by channel: light times reflectance.
    friend MIR_HD constexpr Rgb operator*(Rgb a, Rgb o) {
        return {a.r * o.r, a.g * o.g, a.b * o.b};
    }
    /// Every channel times `s`.
    friend MIR_HD constexpr Rgb operator*(Rgb a, float s) { return {a.r * s, a.g * s, a.b * s}; }
    /// Every channel times `s`, with the bits of `a * s`.
    friend MIR_HD constexpr Rgb operator*(float s, Rgb a) { return a * s; }
    /// True when all channels are equal; false for NaN.
    friend MIR_HD constexpr bool operator==(Rgb a, Rgb o) = default;
};

/// Rec. 709 luminance, in the unit of `c`. Strictly positive weights, so no colour is lost to it.
MIR_HD constexpr float luminance(Rgb c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

/// Largest channel.
MIR_HD constexpr float max_channel(Rgb c) {
    const float rg = c.r > c.g ? c.r : c.g;
    return rg > c.b ? rg : c.b;
}

/// `c` where `on` is true, black elsewhere, whatever `c` is. No branches.
MIR_HD constexpr Rgb kept_if(bool on, Rgb c) {
    return {on ? c.r : 0.0f, on ? c.g : 0.0f, on ? c.b : 0.0f};
}

/// `sum` + `c` where `on` is true, `sum` elsewhere, whatever `c` is. No branches.
MIR_HD constexpr Rgb sum_if(bool on, Rgb sum, Rgb c) {
    return {on ? sum.r + c.r : sum.r, on ? sum.g + c.g : sum.g, on ? sum.b + c.b : sum.b};
}

/// True when every channel is exactly zero. No branches: loops over lanes ask it.
MIR_HD constexpr bool is_black(Rgb c) {
    return (static_cast<int>(c.r == 0.0f) & static_cast<int>(c.g == 0.0f) &
            static_cast<int>(c.b == 0.0f)) != 0;
}

/// True when no channel is NaN or infinite.
MIR_HD constexpr bool is_finite(Rgb c) {
    return is_finite(static_cast<double>(c.r)) && is_finite(static_cast<double>(c.g)) &&
           is_finite(static_cast<double>(c.b));
}

}  // namespace mir
