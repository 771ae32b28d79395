// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace mir {

/// How exposed radiance becomes the light of a screen.
enum class ToneCurve {
    none,      ///< clamped
    reinhard,  ///< x / (1 + x), channel by channel
    aces,      ///< a film's curve, channel by channel
    agx        ///< a film's curve under which bright colours fade to white
};

/// A tone curve by its name in options and reports.
struct ToneCurveName {
    std::string_view name;   ///< key in options
    std::string_view label;  ///< for readers
    ToneCurve curve;         ///< which it is
};

/// Every tone curve.
inline constexpr std::array<ToneCurveName, 4> tone_curve_names{
    {{"aces", "ACES (Narkowicz)", ToneCurve::aces},
     {"agx", "AgX (Sobotka)", ToneCurve::agx},
     {"reinhard", "Reinhard", ToneCurve::reinhard},
     {"none", "none (clamped)", ToneCurve::none}}};

namespace detail {

/// Sobotka's AgX without a look, in Wrensch's polynomial fit of 2023. It mixes the channels,
/// applies a sigmoid over 16.5 stops around middle grey, undoes the mixture, and applies the
/// screen's power of 2.2.
inline std::array<double, 3> agx_curve(const std::array<double, 3>& c) {
    constexpr double low = -12.47393;
    constexpr double high = 4.026069;
    const auto sigmoid = [](double value) {
        const double stops = std::log2(std::max(value, 1e-10));
        const double x = std::clamp((stops - low) / (high - low), 0.0, 1.0);
        const double x2 = x * x;
        const double x4 = x2 * x2;
        return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 +
               0.1191 * x - 0.00232;
    };
    const double r =
        sigmoid(0.842479062253094 * c[0] + 0.0784335999999992 * c[1] + 0.0792237451477643 * c[2]);
    const double g =
        sigmoid(0.0423282422610123 * c[0] + 0.878468636469772 * c[1] + 0.0791661274605434 * c[2]);
    const double b =
        sigmoid(0.0423756549057051 * c[0] + 0.0784336 * c[1] + 0.879142973793104 * c[2]);
    const auto shown = [](double value) { return std::pow(std::max(value, 0.0), 2.2); };
    return {shown(1.19687900512017 * r - 0.0980208811401368 * g - 0.0990297440797205 * b),
            shown(-0.0528968517574562 * r + 1.15190312990417 * g - 0.0989611768448433 * b),
            shown(-0.0529716355144438 * r - 0.0980434501171241 * g + 1.15107367264116 * b)};
}

inline double tone_of(double x, ToneCurve curve) {
    if (curve == ToneCurve::reinhard) return x / (1.0 + x);
    if (curve == ToneCurve::aces) return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    return x;
}

/// A channel in the range of the curves: not negative, no NaN, no overflow.
inline double tone_input(float value) {
    return value > 0.0f ? std::min(static_cast<double>(value), 1e9) : 0.0;
}

}  // namespace detail

/// Linear light of a screen, 0..1, for exposed radiance. NaN and negative channels are black.
/// Sources: Reinhard et al., "Photographic tone reproduction for digital images", ACM Transactions
/// on Graphics 21(3), 2002, equation 3; Narkowicz, "ACES filmic tone mapping curve", 2015; AgX as
/// Blender has it since version 4.0.
[[nodiscard]] inline Rgb toned(Rgb exposed, ToneCurve curve) {
    std::array<double, 3> c{detail::tone_input(exposed.r), detail::tone_input(exposed.g),
                            detail::tone_input(exposed.b)};
    if (curve == ToneCurve::agx)
        c = detail::agx_curve(c);
    else
        for (double& x : c) x = detail::tone_of(x, curve);
    const auto shown = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
    return {shown(c[0]), shown(c[1]), shown(c[2])};
}

/// Exposure in stops (EV) that maps the picture's mean brightness to middle grey, 0.18. Multiply
/// radiance by 2^EV. The mean is the geometric mean of luminance over pixels that are not black,
/// where those below the 5th percentile and above the 95th count as lying there: a black
/// background, lamps and sparks change little. 0 when all are black. Pixels that are not finite are
/// left out.
[[nodiscard]] inline float tone_exposure(const Image<Rgb>& linear) {
    std::vector<float> values;
    for (const Rgb& pixel : linear.pixels())
        if (const float y = luminance(pixel); std::isfinite(y) && y > 0.0f) values.push_back(y);
    if (values.empty()) return 0.0f;
    std::vector<float> ordered = values;
    const auto percentile = [&ordered](std::size_t twentieths) {
        const std::size_t at = (ordered.size() - 1) * twentieths / 20;
        const auto nth = ordered.begin() + static_cast<std::ptrdiff_t>(at);
        std::nth_element(ordered.begin(), nth, ordered.end());
        return *nth;
    };
    const float low = percentile(1);
    const float high = percentile(19);
    double sum = 0.0;
    for (const float y : values) sum += std::log2(static_cast<double>(std::clamp(y, low, high)));
    return static_cast<float>(std::log2(0.18) - sum / static_cast<double>(values.size()));
}

}  // namespace mir
