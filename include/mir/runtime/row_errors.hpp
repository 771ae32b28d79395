// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mir {

/// Standard error of a picture's mean luminance, from how its rows of pixels differ. Rows must be
/// independent. Each is compared with the mean of its two neighbours: what the picture itself
/// changes there counts as noise, unless it changes evenly, so that the error comes out too large
/// rather than too small. `rows` are sums over luxels; `per_pixel` of them make a row of pixels;
/// the error is that of the mean over `luxels` luxels. None for fewer than three rows, or where all
/// are black.
[[nodiscard]] inline std::optional<double> error_of_rows(std::span<const double> rows,
                                                         std::uint32_t per_pixel,
                                                         std::uint64_t luxels) {
    std::vector<double> pixels((rows.size() + per_pixel - 1) / per_pixel);
    for (std::size_t y = 0; y < rows.size(); ++y) pixels[y / per_pixel] += rows[y];
    if (pixels.size() < 3) return std::nullopt;
    double squares = 0.0;
    for (std::size_t y = 1; y + 1 < pixels.size(); ++y) {
        const double bend = pixels[y] - 0.5 * (pixels[y - 1] + pixels[y + 1]);
        squares += bend * bend;
    }
    if (!(squares > 0.0)) return std::nullopt;
    // The variance of three independent rows of equal variance s^2: (1 + 1/4 + 1/4) s^2.
    const double of_row = squares / (1.5 * static_cast<double>(pixels.size() - 2));
    return std::sqrt(of_row * static_cast<double>(pixels.size())) / static_cast<double>(luxels);
}

/// Fills in the standard errors of mean luminances from all rows of an image.
inline void keep_row_errors(RenderStatistics& s, std::span<const RowLuminances> rows) {
    const auto error = [&](double RowLuminances::*of) {
        std::vector<double> sums;
        for (const RowLuminances& row : rows) sums.push_back(row.*of);
        return error_of_rows(sums, s.luxel_rows_per_pixel, s.luxels);
    };
    s.direct_error = error(&RowLuminances::direct);
    s.residual_error = error(&RowLuminances::residual);
    s.caustic_error = error(&RowLuminances::caustic);
}

}  // namespace mir
