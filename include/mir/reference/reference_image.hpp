// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/reference/rgb_moments.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace mir {

/// Radiance of an image split by bounce, with its moments, W m^-2 sr^-1. Moments are over
/// independent replicates, in double precision. D_0 to D_last have layers of their own; all
/// bounces, later ones included, are in the beauty. Filling different pixels from different threads
/// is safe.
class ReferenceImage {
 public:
    /// Black, for `replicates` replicates; `last_bounce` is the last that gets a layer.
    ReferenceImage(Extent extent, std::uint8_t last_bounce, std::uint32_t replicates)
        : extent_(extent),
          last_bounce_(last_bounce),
          replicates_(replicates),
          moments_(static_cast<std::size_t>(extent.area()) * layers()) {}

    /// Size in luxels.
    [[nodiscard]] Extent extent() const { return extent_; }
    /// Last bounce with a layer of its own.
    [[nodiscard]] std::uint8_t last_bounce() const { return last_bounce_; }
    /// Replicates that each pixel is to get; variances divide by them.
    [[nodiscard]] std::uint32_t replicates() const { return replicates_; }

    /// Adds one replicate of pixel (x, y) after `earlier` others. The mean radiance of every
    /// bounce; those not given are black, those behind `last_bounce` may be one sum.
    void add(std::uint32_t x, std::uint32_t y, std::uint32_t earlier,
             std::span<const RgbSum> bounces) {
        RgbMoments* const pixel = first_layer(x, y);
        RgbSum sum;
        for (std::size_t b = 0; b < bounces.size(); ++b) {
            if (b <= last_bounce_) pixel[b].add(bounces[b], earlier);
            sum += bounces[b];
        }
        pixel[beauty_layer()].add(sum, earlier);
    }

    /// Moments of D_b at a pixel, b <= last_bounce().
    [[nodiscard]] const RgbMoments& bounce_moments(std::uint32_t x, std::uint32_t y,
                                                   std::uint8_t b) const {
        return first_layer(x, y)[b];
    }
    /// Moments of the sum of all bounces at a pixel.
    [[nodiscard]] const RgbMoments& beauty_moments(std::uint32_t x, std::uint32_t y) const {
        return first_layer(x, y)[beauty_layer()];
    }

    /// D_b: light that was scattered b times. Black beyond last_bounce().
    [[nodiscard]] Image<Rgb> bounce(std::uint8_t b) const {
        return image([&](const RgbMoments* pixel) {
            return b <= last_bounce_ ? pixel[b].mean.rgb() : Rgb{};
        });
    }

    /// L_n = D_0 + ... + D_n, n at most last_bounce(): emission, direct light and n - 1 indirect
    /// bounces.
    [[nodiscard]] Image<Rgb> up_to(std::uint8_t n) const {
        return image([&](const RgbMoments* pixel) {
            RgbSum sum;
            for (std::size_t b = 0; b <= std::min(n, last_bounce_); ++b) sum += pixel[b].mean;
            return sum.rgb();
        });
    }

    /// Sum of all bounces.
    [[nodiscard]] Image<Rgb> beauty() const {
        return image([&](const RgbMoments* pixel) { return pixel[beauty_layer()].mean.rgb(); });
    }

    /// Variance of the mean of every pixel of the beauty, (W m^-2 sr^-1)^2.
    /// @throws Error(invalid_argument) for fewer than two replicates.
    [[nodiscard]] Image<Rgb> beauty_variance() const {
        return image([&](const RgbMoments* pixel) {
            return pixel[beauty_layer()].variance_of_mean(replicates_).rgb();
        });
    }

    /// The same of D_b, b <= last_bounce().
    [[nodiscard]] Image<Rgb> bounce_variance(std::uint8_t b) const {
        return image(
            [&](const RgbMoments* pixel) { return pixel[b].variance_of_mean(replicates_).rgb(); });
    }

 private:
    [[nodiscard]] std::size_t layers() const { return std::size_t{last_bounce_} + 2; }
    [[nodiscard]] std::size_t beauty_layer() const { return std::size_t{last_bounce_} + 1; }
    [[nodiscard]] std::size_t offset(std::uint32_t x, std::uint32_t y) const {
        return (std::size_t{y} * extent_.width + x) * layers();
    }
    [[nodiscard]] RgbMoments* first_layer(std::uint32_t x, std::uint32_t y) {
        return moments_.data() + offset(x, y);
    }
    [[nodiscard]] const RgbMoments* first_layer(std::uint32_t x, std::uint32_t y) const {
        return moments_.data() + offset(x, y);
    }

    template <class OfPixel>
    [[nodiscard]] Image<Rgb> image(const OfPixel& of_pixel) const {
        Image<Rgb> out(extent_);
        for (std::uint32_t y = 0; y < extent_.height; ++y)
            for (std::uint32_t x = 0; x < extent_.width; ++x)
                out(x, y) = of_pixel(first_layer(x, y));
        return out;
    }

    Extent extent_;
    std::uint8_t last_bounce_;
    std::uint32_t replicates_;
    std::vector<RgbMoments> moments_;  ///< the layers of a pixel side by side, beauty last
};

}  // namespace mir
