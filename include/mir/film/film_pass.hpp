// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/film/detail/tap_view.hpp"
#include "mir/film/luxel_grid.hpp"

namespace mir {

/// Kernel over the luxels of a band in row order. Where each lies in its pixel.
struct LuxelOffsets {
    LuxelGrid grid;               ///< of the whole image
    std::uint64_t seed = 0;       ///< that placed the luxels
    std::uint32_t first_row = 0;  ///< of the band in the image of luxels
    Vec2* out = nullptr;          ///< a place in the pixel, (0, 1)^2, for each luxel of the band

    /// Luxel i of the band.
    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t width = grid.luxels().width;
        const std::uint32_t x = i % width;
        const std::uint32_t y = first_row + i / width;
        const std::uint32_t nx = grid.per_pixel_x;
        const std::uint32_t ny = grid.per_pixel_y;
        out[i] = grid.pattern(x / nx, y / ny, seed)(x % nx, y % ny);
    }
};

/// The sums of a film's pixels while luxels come. For each pixel one of weights, then three for
/// each layer. Rows of pixels take turns in a ring of rows. A view.
struct FilmSums {
    double* sums = nullptr;    ///< planes() planes of rows * width sums
    std::uint32_t width = 0;   ///< pixels
    std::uint32_t rows = 0;    ///< of the ring
    std::uint32_t layers = 0;  ///< colours that share the weights

    /// Planes: one of weights, then red, green and blue of each layer.
    [[nodiscard]] MIR_HD std::size_t planes() const { return 1 + std::size_t{3} * layers; }
    /// Distance from one plane to the next.
    [[nodiscard]] MIR_HD std::size_t stride() const { return std::size_t{rows} * width; }
    /// Sum of weights of a pixel; those of the layers lie behind it.
    [[nodiscard]] MIR_HD double* at(std::uint32_t px, std::uint32_t py) const {
        return sums + std::size_t{py % rows} * width + px;
    }
};

/// Kernel over the pixels that a band of luxels reaches, in row order. Adds what Film::add_rows()
/// adds to them, in its order.
template <class Layer>
struct FilmPass {
    LuxelGrid grid;                 ///< of the whole image
    detail::TapView taps;           ///< of the filter; views, like this
    const Vec2* offsets = nullptr;  ///< LuxelOffsets of the band
    const Layer* layers = nullptr;  ///< colour of luxel (x, y) of the band: layers[l](x, y)
    FilmSums to;  ///< of the film; rows of the ring must hold all pixels that the band reaches
    std::uint32_t first_row = 0;        ///< of the band in the image of luxels
    std::uint32_t rows = 0;             ///< of the band
    std::uint32_t first_pixel_row = 0;  ///< of the pixels that the kernel runs over

    /// Pixel i from row `first_pixel_row` on. Touches that pixel's sums alone.
    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t px = i % to.width;
        const std::uint32_t py = first_pixel_row + i / to.width;
        const std::uint32_t reach = taps.reach;
        const std::uint32_t ny = grid.per_pixel_y;
        const std::uint32_t end =
            py + reach + 1 < grid.pixels.height ? py + reach + 1 : grid.pixels.height;
        for (std::uint32_t row = (py < reach ? 0 : py - reach) * ny; row < end * ny; ++row) {
            if (row < first_row || row >= first_row + rows) continue;
            const std::uint32_t tap = py + reach - row / ny;
            if (taps.y(row % ny).holds(tap)) add_row(px, row, tap, to.at(px, py));
        }
    }

 private:
    MIR_HD void add_row(std::uint32_t px, std::uint32_t row, std::uint32_t tap_y,
                        double* sums) const {
        const std::uint32_t nx = grid.per_pixel_x;
        for (std::uint32_t cell = 0; cell < nx; ++cell) {
            const detail::TapRange range = taps.x(cell);
            for (std::uint32_t tap = range.begin; tap < range.end; ++tap) {
                const std::uint32_t luxel_px = px + taps.reach - tap;  // wraps left of the image
                if (luxel_px < grid.pixels.width)
                    add_luxel(luxel_px * nx + cell, row - first_row, tap, tap_y, sums);
            }
        }
    }

    MIR_HD void add_luxel(std::uint32_t x, std::uint32_t y, std::uint32_t tap_x,
                          std::uint32_t tap_y, double* sums) const {
        const Vec2 offset = offsets[std::size_t{y} * grid.luxels().width + x];
        const double along_x = taps.weight(tap_x, offset.x);
        const double along_y = taps.weight(tap_y, offset.y);
        const std::size_t stride = to.stride();
        sums[0] += along_x * along_y;
        for (std::uint32_t l = 0; l < to.layers; ++l) {
            const Rgb colour = layers[l](x, y);
            double* const sum = sums + (1 + std::size_t{3} * l) * stride;
            sum[0] += along_x * (along_y * static_cast<double>(colour.r));
            sum[stride] += along_x * (along_y * static_cast<double>(colour.g));
            sum[2 * stride] += along_x * (along_y * static_cast<double>(colour.b));
        }
    }
};

/// Kernel over a FilmSeam's pixels in row order: copies their sums from a film.
struct LeaveSeam {
    FilmSums from;                ///< of the film that ends
    std::uint32_t first_row = 0;  ///< of pixels
    std::uint32_t rows = 0;       ///< of pixels
    double* sums = nullptr;       ///< FilmSeam::sums

    /// Pixel i from row `first_row` on.
    MIR_HD void operator()(std::uint32_t i) const {
        const double* const pixel = from.at(i % from.width, first_row + i / from.width);
        for (std::size_t k = 0; k < from.planes(); ++k)
            sums[k * rows * from.width + i] = pixel[k * from.stride()];
    }
};

/// Kernel over the same pixels: copies their sums to a film.
struct EnterSeam {
    FilmSums to;                   ///< of the film that goes on
    std::uint32_t first_row = 0;   ///< of pixels
    std::uint32_t rows = 0;        ///< of pixels
    const double* sums = nullptr;  ///< FilmSeam::sums

    /// Pixel i from row `first_row` on.
    MIR_HD void operator()(std::uint32_t i) const {
        double* const pixel = to.at(i % to.width, first_row + i / to.width);
        for (std::size_t k = 0; k < to.planes(); ++k)
            pixel[k * to.stride()] = sums[k * rows * to.width + i];
    }
};

/// Kernel over finished pixels in row order. Writes their colours, layer after layer, as
/// Film::develop() makes them, and clears their sums for the next turn of the ring.
struct DevelopPass {
    FilmSums from;                      ///< of the film
    std::uint32_t per_pixel = 1;        ///< luxels
    std::uint32_t first_pixel_row = 0;  ///< of the pixels that are finished
    std::uint32_t rows = 0;             ///< of pixels
    Rgb* out = nullptr;                 ///< layers * rows * width colours, W m^-2 sr^-1

    /// Pixel i from row `first_pixel_row` on.
    MIR_HD void operator()(std::uint32_t i) const {
        double* const sums = from.at(i % from.width, first_pixel_row + i / from.width);
        const double weight = sums[0];
        const bool none = fabs(weight) < 1e-3 * per_pixel;
        const std::size_t stride = from.stride();
        for (std::uint32_t l = 0; l < from.layers; ++l) {
            const double* const red = sums + (1 + std::size_t{3} * l) * stride;
            out[std::size_t{l} * rows * from.width + i] =
                none ? Rgb{}
                     : Rgb{static_cast<float>(red[0] / weight),
                           static_cast<float>(red[stride] / weight),
                           static_cast<float>(red[2 * stride] / weight)};
        }
        for (std::size_t k = 0; k < from.planes(); ++k) sums[k * stride] = 0.0;
    }
};

}  // namespace mir
