// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/flip.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace mir {

/// The exposures at which HDR-FLIP looks at two images, evenly spaced.
struct FlipExposures {
    float start = 0.0f;       ///< EV; the brightest pixel is mapped to 0.85 of the display's white
    float stop = 0.0f;        ///< EV; the median is
    std::uint32_t count = 2;  ///< at least 2

    /// EV number i.
    [[nodiscard]] float at(std::uint32_t i) const {
        return start + static_cast<float>(i) * (stop - start) / static_cast<float>(count - 1);
    }
};

namespace detail {

/// Tone curve of HDR-FLIP: Narkowicz's fit to ACES with its own exposure, 0.6. It is (a x^2 + b x)
/// / (c x^2 + d x + e) of scene-referred x.
struct AcesCurve {
    static constexpr float exposure = 0.6f;
    static constexpr float a = 2.51f, b = 0.03f, c = 2.43f, d = 0.59f, e = 0.14f;

    /// Light of the display, 0 to 1. Far above white, where it stays, x is cut before it overflows.
    static float value(float x) {
        const float t = std::clamp(exposure * x, 0.0f, 100.0f);
        return std::min((a * t * t + b * t) / (c * t * t + d * t + e), 1.0f);
    }

    /// The x of a value in (0, 1].
    static double inverse(double y) {
        const double q = a - y * c;
        const double l = b - y * d;
        return (-l + std::sqrt(l * l + 4.0 * q * y * e)) / (2.0 * q * exposure);
    }
};

/// An image as the display shows it at an exposure.
inline Image<Rgb> tone_mapped(const Image<Rgb>& image, float exposure_ev) {
    const float scale = std::exp2(exposure_ev);
    Image<Rgb> out(image.extent());
    std::transform(image.pixels().begin(), image.pixels().end(), out.pixels().begin(), [&](Rgb c) {
        return Rgb{AcesCurve::value(scale * c.r), AcesCurve::value(scale * c.g),
                   AcesCurve::value(scale * c.b)};
    });
    return out;
}

}  // namespace detail

/// Exposures for a reference. From the one that tames its brightest pixel to the one that shows its
/// median (the upper one of an even number; at least 2^-23, where more than half is black).
/// @pre the image has a pixel.
inline FlipExposures flip_exposures(const Image<Rgb>& reference) {
    std::vector<float> values;
    for (const Rgb& pixel : reference.pixels()) values.push_back(luminance(pixel));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    const float dimmest = std::numeric_limits<float>::epsilon();
    const float median = std::max(*middle, dimmest);
    const float largest = std::max(*std::max_element(middle, values.end()), dimmest);
    const double white = detail::AcesCurve::inverse(0.85);
    FlipExposures range{static_cast<float>(std::log2(white / largest)),
                        static_cast<float>(std::log2(white / median))};
    range.count = std::max(2u, static_cast<std::uint32_t>(std::ceil(range.stop - range.start)));
    return range;
}

/// HDR-FLIP: the largest LDR-FLIP of each pixel over a range of exposures. Each is tone mapped with
/// Narkowicz's fit to ACES. Numbers are scene-referred and linear; negative ones count as 0. Not
/// symmetric: the exposures are flip_exposures(reference). The result does not depend on the
/// executor.
/// @throws Error as ldr_flip().
/// Source: Andersson, Nilsson, Shirley and Akenine-Moller, "Visualizing Errors in Rendered High
/// Dynamic Range Images", 2021.
template <class E = InlineExecutor>
    requires(Executor<std::remove_reference_t<E>>)
Image<float> hdr_flip(const Image<Rgb>& image, const Image<Rgb>& reference,
                      float pixels_per_degree = default_pixels_per_degree, E&& executor = {}) {
    check_comparable(image, reference);
    const FlipExposures exposures = flip_exposures(reference);
    Image<float> worst(image.extent());
    for (std::uint32_t i = 0; i < exposures.count; ++i) {
        const Image<float> errors =
            ldr_flip(detail::tone_mapped(image, exposures.at(i)),
                     detail::tone_mapped(reference, exposures.at(i)), pixels_per_degree, executor);
        for (std::size_t p = 0; p < worst.pixels().size(); ++p)
            worst.pixels()[p] = std::max(worst.pixels()[p], errors.pixels()[p]);
    }
    return worst;
}

}  // namespace mir
