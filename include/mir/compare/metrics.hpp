// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/comparable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace mir {

/// Largest difference of two images, in one channel of one pixel.
struct LargestDifference {
    double value = 0.0;       ///< image - reference, with its sign, in the unit of the images
    std::uint32_t x = 0;      ///< from 0 at the left
    std::uint32_t y = 0;      ///< from 0 at the top
    std::size_t channel = 0;  ///< 0 red, 1 green, 2 blue
};

/// How an image differs from a reference. Means are over all pixels and the three channels of
/// linear Rec. 709; L is the unit of the images, for pictures W m^-2 sr^-1.
struct ImageMetrics {
    double mse = 0.0;              ///< mean of (a - b)^2, L^2
    double rel_mse = 0.0;          ///< mean of (a - b)^2 / (b^2 + epsilon); b is the reference
    double mae = 0.0;              ///< mean of |a - b|, L
    std::array<double, 3> mean{};  ///< of each channel of the image, L
    std::array<double, 3> reference_mean{};  ///< of each channel of the reference, L
    LargestDifference largest;               ///< the first in row order where several are equal

    /// Root of the mean squared error, L.
    [[nodiscard]] double rmse() const { return std::sqrt(mse); }

    /// |mean - reference_mean| / |reference_mean| of the channel where it is largest. Two zeros
    /// differ by 0, a mean of zero and another by infinity.
    [[nodiscard]] double mean_difference() const {
        double most = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            if (const double d = std::fabs(mean[c] - reference_mean[c]); d > 0.0)
                most = std::max(most, reference_mean[c] == 0.0
                                          ? std::numeric_limits<double>::infinity()
                                          : d / std::fabs(reference_mean[c]));
        return most;
    }
};

/// Epsilon of the relative squared error where none is given, L^2. Where the reference is darker
/// than 0.1, differences count less than relatively. The value of Rousselle, Knaus and Zwicker,
/// "Adaptive Sampling and Reconstruction using Greedy Error Minimization", 2011.
inline constexpr double default_rel_mse_epsilon = 0.01;

namespace detail {

inline std::array<double, 3> channels_of(Rgb c) { return {c.r, c.g, c.b}; }

/// Adds what one pixel contributes; sums, not yet means.
inline void add_pixel(ImageMetrics& m, Rgb image, Rgb reference, double epsilon, std::uint32_t x,
                      std::uint32_t y) {
    const std::array<double, 3> a = channels_of(image);
    const std::array<double, 3> b = channels_of(reference);
    for (std::size_t c = 0; c < 3; ++c) {
        const double d = a[c] - b[c];
        m.mse += d * d;
        m.mae += std::fabs(d);
        if (d != 0.0) m.rel_mse += d * d / (b[c] * b[c] + epsilon);
        m.mean[c] += a[c];
        m.reference_mean[c] += b[c];
        if (std::fabs(d) > std::fabs(m.largest.value)) m.largest = {d, x, y, c};
    }
}

}  // namespace detail

/// Compares an image with its reference, pixel by pixel. Sums are of doubles in row order.
/// `epsilon` is that of ImageMetrics::rel_mse and not negative; with 0 a difference where the
/// reference is black makes it infinite. Thread-safe.
/// @throws Error(invalid_input) as check_comparable(), Error(invalid_argument) for the epsilon.
inline ImageMetrics compare_images(const Image<Rgb>& image, const Image<Rgb>& reference,
                                   double epsilon = default_rel_mse_epsilon) {
    check_comparable(image, reference);
    expects(epsilon >= 0.0 && std::isfinite(epsilon),
            "the epsilon of the relative squared error is no finite number from 0 up (it keeps "
            "dark pixels from counting without bound); use 0.01");
    ImageMetrics m;
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x)
            detail::add_pixel(m, image(x, y), reference(x, y), epsilon, x, y);
    const auto pixels = static_cast<double>(image.extent().area());
    for (double* sum : {&m.mse, &m.rel_mse, &m.mae}) *sum /= 3.0 * pixels;
    for (std::size_t c = 0; c < 3; ++c) {
        m.mean[c] /= pixels;
        m.reference_mean[c] /= pixels;
    }
    return m;
}

/// Mean of all pixels, summed in row order as doubles.
/// @pre the image has a pixel.
inline double mean_of(const Image<float>& image) {
    double sum = 0.0;
    for (const float value : image.pixels()) sum += value;
    return sum / static_cast<double>(image.extent().area());
}

}  // namespace mir
