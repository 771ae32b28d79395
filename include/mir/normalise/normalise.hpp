// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"
#include "mir/normalise/response.hpp"

namespace mir {

/// What a normalisation could not place.
struct NormalisationReport {
    double dropped_share = 0.0;         ///< of the recorded states, 0..1: light that is lost
    std::uint32_t dropped_records = 0;  ///< path VPLs that light no luxel
};

/// Image luminance, W m^-2 sr^-1, of a VPL of response `t` and intensity `radiance`. S of
/// docs/method.md, 10.1.
inline double image_luminance(const ImageResponse& t, Rgb radiance) {
    constexpr double red = luminance(Rgb{1, 0, 0});
    constexpr double green = luminance(Rgb{0, 1, 0});
    constexpr double blue = luminance(Rgb{0, 0, 1});
    return red * t.r * static_cast<double>(radiance.r) +
           green * t.g * static_cast<double>(radiance.g) +
           blue * t.b * static_cast<double>(radiance.b);
}

namespace detail {

/// In double: neither the factor nor a faint colour need fit single precision.
inline Rgb scaled(Rgb c, double factor) {
    const auto scale = [factor](float x) {
        return static_cast<float>(static_cast<double>(x) * factor);
    };
    return {scale(c.r), scale(c.g), scale(c.b)};
}

}  // namespace detail

/// Makes intensities of the radiance R that path VPLs hold. J = P_c / n * weight * R / S, so each
/// recorded state brings the same luminance P_c / n to the image. Path VPLs that light no luxel
/// become black; their flux is lost and reported, not given to others. `path_luminance` is P_c, W
/// m^-2 sr^-1, `states` is n. Never yields NaN or infinity. Source: equations 8 to 10 of the paper,
/// with one response per geometric VPL (docs/method.md, 10.1).
/// @throws Error(invalid_argument) unless there is one response for each geometric VPL.
inline NormalisationReport normalise(VplList& vpls, std::span<const ImageResponse> responses,
                                     double path_luminance, double states) {
    expects(responses.size() == vpls.size(),
            "VPLs were normalised by responses of other VPLs (each geometric VPL needs one); give "
            "as many as there are VPLs");
    NormalisationReport report;
    std::vector<Rgb> intensities;
    double dropped = 0.0;
    for (const PathVpl& p : vpls.path_vpls()) {
        const double s = image_luminance(responses[p.vpl], p.intensity);
        const double weight = static_cast<double>(p.weight);
        const Rgb j = detail::scaled(p.intensity, path_luminance * weight / (states * s));
        const bool lights = s > 0.0 && is_finite(j);
        intensities.push_back(lights ? j : Rgb{});
        if (lights) continue;
        dropped += weight;
        ++report.dropped_records;
    }
    vpls.relight(intensities);
    if (states > 0.0) report.dropped_share = dropped / states;
    return report;
}

}  // namespace mir
