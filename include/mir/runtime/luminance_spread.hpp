// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace mir {

/// Spread of the luminance of independent pictures of one thing. Pixel by pixel, in double
/// precision (Welford 1962). One thread at a time.
class LuminanceSpread {
 public:
    /// Adds picture `earlier` + 1; all have one size.
    void add(const Image<Rgb>& picture, std::uint32_t earlier) {
        if (earlier == 0) pixels_ = Image<Moments>(picture.extent());
        for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
            Moments& m = pixels_.pixels()[i];
            const auto y = static_cast<double>(luminance(picture.pixels()[i]));
            const double delta = y - m.mean;
            m.mean += delta / (earlier + 1.0);
            m.squares += delta * (y - m.mean);
        }
    }

    /// Error of the mean of `count` pictures, relative to its brightness. It is sqrt(mean over
    /// pixels of s^2 / count) / mean over pixels of luminance, where s^2 is a pixel's unbiased
    /// variance over the pictures. Its square is, apart from the divisor, an unbiased estimate of
    /// the mean square error against the expected picture. None for fewer than two pictures;
    /// infinite for pictures that differ and are black on average.
    [[nodiscard]] std::optional<double> relative_error(std::uint32_t count) const {
        if (count < 2) return std::nullopt;
        double squares = 0.0;
        double luminance = 0.0;
        for (const Moments& m : pixels_.pixels()) {
            squares += m.squares;
            luminance += m.mean;
        }
        if (squares == 0.0) return 0.0;
        if (!(luminance > 0.0)) return std::numeric_limits<double>::infinity();
        const auto n = static_cast<double>(pixels_.pixels().size());
        return std::sqrt(squares / n / (count * (count - 1.0))) / (luminance / n);
    }

    /// Hands all that `self` consists of to `archive`, which reads or, unless const, replaces it.
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
        archive(self.pixels_);
    }

 private:
    struct Moments {
        double mean = 0.0;
        double squares = 0.0;  ///< sum of squared deviations from the mean
    };

    Image<Moments> pixels_;
};

}  // namespace mir
