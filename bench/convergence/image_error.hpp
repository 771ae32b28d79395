// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/comparable.hpp"
#include "reference.hpp"

#include <algorithm>
#include <cmath>

namespace mirconvergence {

/// How far the indirect light of an image is from a reference, by luminance.
struct ImageError {
    double rmse = 0.0;             ///< W m^-2 sr^-1; the reference's own error is taken off
    double mean = 0.0;             ///< of the image, W m^-2 sr^-1
    double reference_mean = 0.0;   ///< W m^-2 sr^-1
    double reference_share = 0.0;  ///< of the squared difference, that the reference's error makes

    /// RMSE over the mean of the reference.
    [[nodiscard]] double relative_rmse() const { return rmse / reference_mean; }
};

/// Root of the mean over pixels of (Y(image) - Y(reference))^2 - Var(Y(reference)). Image and
/// reference are independent, so that each term has the expectation of the squared error against
/// the true image, however noisy the reference is; below zero, the root is given as 0.
/// @throws mir::Error(invalid_input) when the images do not fit or hold NaN.
inline ImageError image_error(const mir::Image<mir::Rgb>& image, const Reference& reference) {
    mir::check_comparable(image, reference.indirect);
    ImageError e;
    double squares = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const double a = mir::luminance(image.pixels()[i]);
        const double b = mir::luminance(reference.indirect.pixels()[i]);
        squares += (a - b) * (a - b);
        variance += static_cast<double>(reference.variance.pixels()[i]);
        e.mean += a;
        e.reference_mean += b;
    }
    const auto pixels = static_cast<double>(image.extent().area());
    e.mean /= pixels;
    e.reference_mean /= pixels;
    e.reference_share = squares > 0.0 ? variance / squares : 0.0;
    e.rmse = std::sqrt(std::max(squares - variance, 0.0) / pixels);
    return e;
}

}  // namespace mirconvergence
