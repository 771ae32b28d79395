// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/comparable.hpp"
#include "mir/compare/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace mir {

/// Parameters of scaled_rel_mse().
struct ScaledRelMseSettings {
    double epsilon = 0.01;       ///< in squares of the reference's mean luminance, from 0 up
    double worst_share = 0.005;  ///< of the pixels, left out of the trimmed mean, [0, 1)
};

/// Squared error in units of the reference's light. The brightness of a scene does not matter.
struct ScaledRelMse {
    double mean = 0.0;     ///< over all pixels and channels; below 0 where noise alone is left
    double trimmed = 0.0;  ///< the same without the worst pixels
};

namespace detail {

/// d e / (r^2 + epsilon), where no difference is none on black either.
inline double scaled_product(double d, double e, double r, double epsilon) {
    const double product = d * e;
    return product == 0.0 ? 0.0 : product / (r * r + epsilon);
}

/// Error of one pixel, and its place in the order of the worst.
struct PixelError {
    double estimate = 0.0;  ///< what the mean is of
    double rank = 0.0;      ///< square of the error against the mean of the references
};

/// Means over the three channels.
inline PixelError pixel_error(Rgb image, Rgb first, Rgb second, double epsilon) {
    const std::array<double, 3> a = channels_of(image);
    const std::array<double, 3> r1 = channels_of(first);
    const std::array<double, 3> r2 = channels_of(second);
    PixelError error;
    for (std::size_t c = 0; c < 3; ++c) {
        const double r = 0.5 * (r1[c] + r2[c]);
        error.estimate += scaled_product(a[c] - r1[c], a[c] - r2[c], r, epsilon) / 3.0;
        error.rank += scaled_product(a[c] - r, a[c] - r, r, epsilon) / 3.0;
    }
    return error;
}

/// Mean luminance of both references.
inline double mean_luminance(const Image<Rgb>& first, const Image<Rgb>& second) {
    double sum = 0.0;
    for (std::size_t i = 0; i < first.pixels().size(); ++i)
        sum += static_cast<double>(luminance(first.pixels()[i])) +
               static_cast<double>(luminance(second.pixels()[i]));
    return 0.5 * sum / static_cast<double>(first.pixels().size());
}

/// Whether each pixel is among the `count` worst. Of equal ones the first in row order are.
inline std::vector<bool> worst_pixels(const std::vector<PixelError>& errors, std::size_t count) {
    std::vector<std::size_t> order(errors.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(order.begin(), end, order.end(), [&](std::size_t i, std::size_t j) {
        return std::pair(-errors[i].rank, i) < std::pair(-errors[j].rank, j);
    });
    std::vector<bool> worst(errors.size());
    std::for_each(order.begin(), end, [&](std::size_t i) { worst[i] = true; });
    return worst;
}

inline ScaledRelMse mean_error(const std::vector<PixelError>& errors, double worst_share) {
    const auto left_out =
        static_cast<std::size_t>(worst_share * static_cast<double>(errors.size()));
    const std::vector<bool> worst = worst_pixels(errors, left_out);
    ScaledRelMse sum;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        sum.mean += errors[i].estimate;
        if (!worst[i]) sum.trimmed += errors[i].estimate;
    }
    return {sum.mean / static_cast<double>(errors.size()),
            sum.trimmed / static_cast<double>(errors.size() - left_out)};
}

}  // namespace detail

/// Estimates the squared error of an image from two independent references.
/// The mean of (a - r1) (a - r2) / (r^2 + epsilon m^2) over pixels and channels, where r is the
/// mean of r1 and r2, and m its mean luminance. Noise of the references averages out of the
/// product, while it adds to a square: so errors far below the references' own can be told. The
/// worst pixels are those furthest from r. Through r, a bias remains of second order in the
/// references' own error, and `trimmed` misses up to about a fiftieth of the latter.
/// Sums are of doubles in row order. Thread-safe.
/// @throws Error(invalid_input) as check_comparable(), Error(invalid_argument) for the settings.
inline ScaledRelMse scaled_rel_mse(const Image<Rgb>& image, const Image<Rgb>& reference,
                                   const Image<Rgb>& second_reference,
                                   const ScaledRelMseSettings& settings = {}) {
    check_comparable(image, reference);
    check_comparable(image, second_reference, "the image", "the second reference");
    expects(settings.epsilon >= 0.0 && std::isfinite(settings.epsilon),
            "the epsilon of the scaled relative error is no finite number from 0 up (it keeps "
            "dark pixels from counting without bound); use 0.01");
    expects(settings.worst_share >= 0.0 && settings.worst_share < 1.0,
            "the share of the worst pixels is not in [0, 1) (the others are what is measured); "
            "use 0.005");
    const double light = detail::mean_luminance(reference, second_reference);
    std::vector<detail::PixelError> errors(image.pixels().size());
    for (std::size_t i = 0; i < errors.size(); ++i)
        errors[i] =
            detail::pixel_error(image.pixels()[i], reference.pixels()[i],
                                second_reference.pixels()[i], settings.epsilon * light * light);
    return detail::mean_error(errors, settings.worst_share);
}

/// The squared error of an image against one reference. Its noise counts as error of the image.
/// @throws Error(invalid_input) as check_comparable(), Error(invalid_argument) for the settings.
inline ScaledRelMse scaled_rel_mse(const Image<Rgb>& image, const Image<Rgb>& reference,
                                   const ScaledRelMseSettings& settings = {}) {
    return scaled_rel_mse(image, reference, reference, settings);
}

}  // namespace mir
