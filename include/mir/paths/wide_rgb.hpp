// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

namespace mir {

/// Rgb with the range of double. A product over the vertices of a path has a factor 1 / m^2 for
/// each: after some ten bounces it leaves the range of float in a hall of 100 m or a box of 1 cm.
struct WideRgb {
    double r = 0.0;  ///< red
    double g = 0.0;  ///< green
    double b = 0.0;  ///< blue

    constexpr WideRgb() = default;
    /// Channels in the unit of what the triple measures.
    MIR_HD constexpr WideRgb(double red, double green, double blue) : r(red), g(green), b(blue) {}
    /// Not explicit: nothing is lost.
    MIR_HD constexpr WideRgb(Rgb c)
        : WideRgb(static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)) {}

    /// Channel by channel.
    friend MIR_HD constexpr WideRgb operator*(const WideRgb& a, const WideRgb& o) {
        return {a.r * o.r, a.g * o.g, a.b * o.b};
    }
    /// Every channel times `s`.
    friend MIR_HD constexpr WideRgb operator*(const WideRgb& a, double s) {
        return {a.r * s, a.g * s, a.b * s};
    }
};

/// Rec. 709 luminance, in the unit of `c`.
MIR_HD constexpr double luminance(const WideRgb& c) {
    constexpr double red = luminance(Rgb{1, 0, 0});
    constexpr double green = luminance(Rgb{0, 1, 0});
    constexpr double blue = luminance(Rgb{0, 0, 1});
    return red * c.r + green * c.g + blue * c.b;
}

/// True when every channel is exactly zero.
MIR_HD constexpr bool is_black(const WideRgb& c) { return c.r == 0.0 && c.g == 0.0 && c.b == 0.0; }

/// In single precision; what is too small becomes 0 and what is too large infinite.
MIR_HD constexpr Rgb narrowed(const WideRgb& c) {
    return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

/// The same colour with luminance 1. `c` must not be black.
MIR_HD constexpr Rgb with_unit_luminance(const WideRgb& c) {
    return narrowed(c * (1.0 / luminance(c)));
}

}  // namespace mir
