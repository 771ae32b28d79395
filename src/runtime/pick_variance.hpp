// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/film/filter.hpp"
#include "mir/film/luxel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace mir {

/// Adds standard errors to those of a gray image. Both hold their squares.
template <Executor E>
void add_errors(Image<Rgb>& to, const Image<float>& more, E& executor) {
    executor.for_each(to.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < to.width(); ++x) {
            const double error = std::sqrt(static_cast<double>(to(x, y).r)) +
                                 std::sqrt(static_cast<double>(more(x, y)));
            const auto square = static_cast<float>(
                std::min(error * error, double{std::numeric_limits<float>::max()}));
            to(x, y) = {square, square, square};
        }
    });
}

/// Variance of a pixel whose luxels err alone, as a share of theirs. A pixel is their mean under a
/// filter; this is the sum of the squares of its weights.
[[nodiscard]] inline double variance_share(const Filter& filter, const LuxelGrid& grid) {
    const auto along = [&](std::uint32_t cells) {
        const auto reach = static_cast<std::int32_t>(std::ceil(filter.half_width + 0.5f));
        double sum = 0.0;
        double squares = 0.0;
        for (std::int32_t pixel = -reach; pixel <= reach; ++pixel)
            for (std::uint32_t cell = 0; cell < cells; ++cell) {
                const float at = (static_cast<float>(cell) + 0.5f) / static_cast<float>(cells);
                const auto w =
                    static_cast<double>(filter.along(static_cast<float>(pixel) + at - 0.5f));
                sum += w;
                squares += w * w;
            }
        return squares / (sum * sum);
    };
    return along(grid.per_pixel_x) * along(grid.per_pixel_y);
}

/// Standard errors of pixels, from the developed layer of their luxels' variances. `share` is
/// variance_share(). Filters with negative lobes leave negative variances, which count as none.
template <Executor E>
[[nodiscard]] Image<float> pick_errors(const Image<Rgb>& variance, double share, E& executor) {
    auto errors = Image<float>::unwritten(variance.extent());
    executor.for_each(variance.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < variance.width(); ++x)
            errors(x, y) = static_cast<float>(
                std::sqrt(std::max(static_cast<double>(variance(x, y).r), 0.0) * share));
    });
    return errors;
}

}  // namespace mir
