// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/film/detail/tap_table.hpp"
#include "mir/film/filter.hpp"
#include "mir/film/luxel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace mir {

/// Turns the radiance of luxels into pixels: L_pixel = sum(w L) / sum(w) over the luxels that the
/// filter reaches. Accumulation is signed: the negative lobes of a filter stay, and with them
/// negative pixels next to strong edges; only a display clamps.
///
/// Every pixel adds its luxels one by one in raster order, so the result is equal in every bit for
/// any cut into bands and any number of threads. Sums are kept in double: a pixel adds up to 4096
/// terms of either sign (64 luxels under a half-width of 4), and radiances next to an emitter
/// differ by many orders of magnitude, where the cancellation of float sums would show.
///
/// One thread at a time may use a Film; it spreads its work through the executor it is given.
class Film {
 public:
    /// `grid` and `seed` must be those that placed the luxels.
    /// @throws Error(invalid_argument) when the filter's half-width lies outside [0.5, 16] pixels
    ///         or its tau is not positive.
    Film(const LuxelGrid& grid, const Filter& filter, std::uint64_t seed)
        : grid_(grid), taps_(grid, filter, seed), sums_(grid.pixels) {}

    /// Adds a band of complete luxel rows, radiance in W m^-2 sr^-1. Bands come from top to bottom
    /// without gaps; their heights are free.
    /// @throws Error(invalid_argument) when the band has the wrong width, does not start where the
    ///         last one ended, or does not fit into the grid.
    template <Executor E>
    void add_rows(E& executor, std::uint32_t first_luxel_row, const Image<Rgb>& luxels);

    /// The same on the calling thread.
    void add_rows(std::uint32_t first_luxel_row, const Image<Rgb>& luxels) {
        InlineExecutor executor;
        add_rows(executor, first_luxel_row, luxels);
    }

    /// The pixels, radiance in W m^-2 sr^-1. May be called between bands: rows of pixels whose own
    /// luxels are not complete are black, the others are filtered from what is there, as at the
    /// border of an image. A pixel whose weights cancel to less than a thousandth of its luxels is
    /// black too; no filter of default_filter() lets that happen.
    [[nodiscard]] Image<Rgb> develop() const;

    [[nodiscard]] const LuxelGrid& grid() const { return grid_; }
    /// Luxel rows added so far.
    [[nodiscard]] std::uint32_t rows() const { return rows_; }

 private:
    struct Sum {
        double r = 0.0;
        double g = 0.0;
        double b = 0.0;
        double weight = 0.0;
    };

    void check_band(std::uint32_t first_luxel_row, const Image<Rgb>& luxels) const;
    /// Adds luxel row `row` to pixel row `py`.
    void add_luxel_row(std::uint32_t py, std::uint32_t row, const Rgb* radiance);
    static void splat(std::span<Sum> pixels, const float* wx, double wy, Rgb radiance);

    LuxelGrid grid_;
    detail::TapTable taps_;
    Image<Sum> sums_;
    std::uint32_t rows_ = 0;
};

inline void Film::check_band(std::uint32_t first_luxel_row, const Image<Rgb>& luxels) const {
    const Extent whole = grid_.luxels();
    if (luxels.width() == whole.width && first_luxel_row == rows_ &&
        luxels.height() <= whole.height - rows_)
        return;
    throw Error(ErrorCode::invalid_argument,
                "a band of " + std::to_string(luxels.width()) + "x" +
                    std::to_string(luxels.height()) + " luxels from row " +
                    std::to_string(first_luxel_row) + " cannot be added to a film of " +
                    std::to_string(whole.width) + "x" + std::to_string(whole.height) +
                    " luxels that has " + std::to_string(rows_) +
                    " rows (bands are complete rows from top to bottom); add the band that starts "
                    "at row " +
                    std::to_string(rows_));
}

template <Executor E>
void Film::add_rows(E& executor, std::uint32_t first_luxel_row, const Image<Rgb>& luxels) {
    check_band(first_luxel_row, luxels);
    const std::uint32_t end = first_luxel_row + luxels.height();
    while (rows_ < end) {
        const std::uint32_t next = rows_ + std::min(taps_.max_rows(), end - rows_);
        taps_.prepare(executor, rows_, next);
        const std::uint32_t above = rows_ / grid_.per_pixel_y;
        const std::uint32_t top = above - std::min(above, taps_.reach());
        const std::uint32_t bottom =
            std::min(grid_.pixels.height - 1, (next - 1) / grid_.per_pixel_y + taps_.reach());
        executor.for_each(bottom - top + 1, [&](std::size_t i) {
            const std::uint32_t py = top + static_cast<std::uint32_t>(i);
            for (std::uint32_t row = rows_; row < next; ++row)
                add_luxel_row(py, row, &luxels(0, row - first_luxel_row));
        });
        rows_ = next;
    }
}

inline void Film::add_luxel_row(std::uint32_t py, std::uint32_t row, const Rgb* radiance) {
    const std::int64_t reach = taps_.reach();
    const std::int64_t tap_y = reach + py - std::int64_t{row / grid_.per_pixel_y};
    if (tap_y < 0 || tap_y > 2 * reach) return;
    Sum* const sums = &sums_(0, py);
    const std::int64_t width = grid_.pixels.width;
    std::uint32_t x = 0;
    for (std::int64_t px = 0; px < width; ++px) {
        const std::int64_t first = std::max<std::int64_t>(px - reach, 0);
        const std::int64_t last = std::min(px + reach, width - 1);
        for (std::uint32_t cell = 0; cell < grid_.per_pixel_x; ++cell, ++x) {
            const double wy = taps_.y(x, row, static_cast<std::uint32_t>(tap_y));
            if (wy == 0.0) continue;
            const float* const wx = taps_.x(x, row) + (first - (px - reach));
            splat({sums + first, sums + last + 1}, wx, wy, radiance[x]);
        }
    }
}

inline void Film::splat(std::span<Sum> pixels, const float* wx, double wy, Rgb radiance) {
    const double r = radiance.r, g = radiance.g, b = radiance.b;
    for (Sum& sum : pixels) {
        const double w = wy * static_cast<double>(*wx++);
        sum.r += w * r;
        sum.g += w * g;
        sum.b += w * b;
        sum.weight += w;
    }
}

inline Image<Rgb> Film::develop() const {
    Image<Rgb> image(grid_.pixels);
    const double least = 1e-3 * grid_.per_pixel();
    const std::uint32_t complete = rows_ / grid_.per_pixel_y;
    for (std::uint32_t y = 0; y < complete; ++y)
        for (std::uint32_t x = 0; x < grid_.pixels.width; ++x) {
            const Sum& sum = sums_(x, y);
            if (std::fabs(sum.weight) < least) continue;
            image(x, y) = {static_cast<float>(sum.r / sum.weight),
                           static_cast<float>(sum.g / sum.weight),
                           static_cast<float>(sum.b / sum.weight)};
        }
    return image;
}

}  // namespace mir
