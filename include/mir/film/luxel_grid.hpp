// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/limits.hpp"
#include "mir/core/math.hpp"
#include "mir/core/random.hpp"
#include "mir/data/tile.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace mir {

/// Most luxels that one pixel can be cut into.
inline constexpr std::uint32_t max_luxels_per_pixel = 64;

/// Where the luxels of one pixel lie: correlated multi-jittered sampling over nx * ny cells. Each
/// axis by itself has exactly one luxel in each of its nx * ny strata. A pure function of the
/// constructor's arguments; reading it from several threads is safe.
/// Source: Kensler, "Correlated Multi-Jittered Sampling", Pixar technical memo 13-01, 2013.
class PixelPattern {
 public:
    /// Cells nx, ny >= 1 of a pixel, nx * ny <= max_luxels_per_pixel. `pixel` is the pixel's raster
    /// index. A luxel that has the pixel alone lies at `only`, in (0, 1)^2.
    MIR_HD PixelPattern(std::uint32_t nx, std::uint32_t ny, std::uint64_t pixel, std::uint64_t seed,
                        Vec2 only = {0.5f, 0.5f})
        : nx_(nx), ny_(ny), only_(only), random_(seed, Stream::luxel, pixel) {
        Random draws = random_;
        shuffle(column_order_, nx, draws);
        shuffle(row_order_, ny, draws);
    }

    /// Position of the luxel of cell (cx, cy), in (0, 1)^2 of the pixel.
    [[nodiscard]] MIR_HD Vec2 operator()(std::uint32_t cx, std::uint32_t cy) const {
        if (nx_ * ny_ == 1) return only_;
        // Even, so that both numbers come from one block of random bits.
        const std::uint32_t dimension = first_jitter + 2 * (cy * nx_ + cx);
        return {inside(cx * ny_ + row_order_.place[cy], random_.at(dimension)),
                inside(cy * nx_ + column_order_.place[cx], random_.at(dimension | 1u))};
    }

 private:
    /// A plain array, because device code cannot index std::array.
    struct Order {
        std::uint8_t place[max_luxels_per_pixel] = {};
    };
    // Beyond every number that the two shuffles draw.
    static constexpr std::uint32_t first_jitter = 2 * max_luxels_per_pixel;

    /// Uniform permutation of 0..n-1 (Fisher and Yates, built inside out).
    MIR_HD static void shuffle(Order& order, std::uint32_t n, Random& draws) {
        for (std::uint32_t i = 1; i < n; ++i) {
            // The product can round up to i + 1.
            const auto drawn = static_cast<std::uint32_t>(draws.next() * static_cast<float>(i + 1));
            const std::uint32_t j = drawn < i ? drawn : i;
            order.place[i] = order.place[j];
            order.place[j] = static_cast<std::uint8_t>(i);
        }
    }

    /// Point of a stratum, never on its border. Jitter is rounded to the middles of 2^16 intervals,
    /// which leaves the sum exact.
    [[nodiscard]] MIR_HD float inside(std::uint32_t stratum, float jitter) const {
        const float kept = (floorf(jitter * 0x1p16f) + 0.5f) * 0x1p-16f;
        return (static_cast<float>(stratum) + kept) / static_cast<float>(nx_ * ny_);
    }

    std::uint32_t nx_;
    std::uint32_t ny_;
    Vec2 only_;
    Random random_;
    Order column_order_;
    Order row_order_;
};

/// How the pixels of an image are cut into luxels. Luxel (x, y) belongs to pixel
/// (x / per_pixel_x, y / per_pixel_y). A small value; make it with luxel_grid().
struct LuxelGrid {
    Extent pixels;                  ///< size of the image
    std::uint32_t per_pixel_x = 1;  ///< luxels of a pixel side by side, at least 1
    std::uint32_t per_pixel_y = 1;  ///< luxels of a pixel one below the other, at least 1
    Vec2 only{0.5f, 0.5f};          ///< place of luxels that have their pixel alone, (0, 1)^2

    /// Luxels of a pixel, at most max_luxels_per_pixel.
    [[nodiscard]] MIR_HD constexpr std::uint32_t per_pixel() const {
        return per_pixel_x * per_pixel_y;
    }

    /// Size of the image of luxels.
    [[nodiscard]] MIR_HD constexpr Extent luxels() const {
        return {pixels.width * per_pixel_x, pixels.height * per_pixel_y};
    }

    /// The luxels of pixel (px, py).
    [[nodiscard]] MIR_HD PixelPattern pattern(std::uint32_t px, std::uint32_t py,
                                              std::uint64_t seed) const {
        return {per_pixel_x, per_pixel_y, std::uint64_t{py} * pixels.width + px, seed, only};
    }

    /// Position of luxel (x, y) in pixels from the image's top left corner. It is `only` for one
    /// luxel per pixel, else multi-jittered inside the pixel. A pure function of (x, y, seed), safe
    /// from any thread.
    [[nodiscard]] MIR_HD Vec2 position(std::uint32_t x, std::uint32_t y, std::uint64_t seed) const {
        const std::uint32_t px = x / per_pixel_x, py = y / per_pixel_y;
        const Vec2 offset = pattern(px, py, seed)(x % per_pixel_x, y % per_pixel_y);
        return {add_down(px, offset.x), add_down(py, offset.y)};
    }

    /// True when image and cuts are equal: then luxels have the same numbers.
    friend bool operator==(const LuxelGrid&, const LuxelGrid&) = default;

 private:
    /// Sum rounded down: rounded to nearest it can leave the pixel.
    MIR_HD static float add_down(std::uint32_t pixel, float offset) {
        const double exact = static_cast<double>(pixel) + static_cast<double>(offset);
        const auto rounded = static_cast<float>(exact);
        return static_cast<double>(rounded) > exact ? nextafterf(rounded, 0.0f) : rounded;
    }
};

/// Cuts each pixel of an image into `luxels_per_pixel` (1 to 64) cells. They are as nearly square
/// as the number's factors allow: 16 gives 4 x 4, 8 gives 2 x 4, a prime n gives 1 x n. One luxel
/// lies at `only`.
/// @throws Error(invalid_argument) for an empty image, a number or place out of range, and
///         Error(limit_exceeded) when the image passes `limits`.
inline LuxelGrid luxel_grid(Extent pixels, std::uint32_t luxels_per_pixel,
                            const Limits& limits = {}, Vec2 only = {0.5f, 0.5f}) {
    expects(only.x > 0.0f && only.x < 1.0f && only.y > 0.0f && only.y < 1.0f,
            "the place of a pixel's only luxel lies outside of the pixel (no ray would be its); "
            "give both coordinates between 0 and 1");
    expects(pixels.width > 0 && pixels.height > 0,
            "an image of zero pixels was asked for (there is nothing to compute); give both a "
            "width and a height");
    if (luxels_per_pixel < 1 || luxels_per_pixel > max_luxels_per_pixel)
        throw Error(ErrorCode::invalid_argument,
                    std::to_string(luxels_per_pixel) +
                        " luxels per pixel were asked for (a pixel holds 1 to 64); average several "
                        "renderings with different seeds for more");
    check_limit(pixels.area(), limits.pixels, "pixels");
    std::uint32_t nx = 1;
    for (std::uint32_t i = 1; i * i <= luxels_per_pixel; ++i)
        if (luxels_per_pixel % i == 0) nx = i;
    const std::uint32_t ny = luxels_per_pixel / nx;
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    expects(std::uint64_t{pixels.width} * nx <= most && std::uint64_t{pixels.height} * ny <= most,
            "the luxels of this image cannot be numbered (one side has more than 2^32 - 1); ask "
            "for fewer luxels per pixel");
    return {pixels, nx, ny, only};
}

}  // namespace mir
