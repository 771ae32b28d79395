// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mir {

/// Factors that bring an estimate of light near the truth, smooth over the image. Both are known at
/// the cells of a grid on the film: a factor is the ratio of their sums over a neighbourhood. As
/// much of it as its noise may explain is left out, first of the factor of the whole image against
/// 1, then of that of a neighbourhood against it (positive-part James-Stein), so that a good
/// estimate stays. Const use from any thread.
class LightCorrection {
 public:
    /// From both in the cells, W m^-2 sr^-1; empty cells are black.
    template <Executor E>
    LightCorrection(const Image<Rgb>& estimate, const Image<Rgb>& truth, E& executor);

    /// Factor at a place on the film, between `least` and 1 / `least`. Places run from (0, 0) to
    /// (1, 1).
    [[nodiscard]] Rgb operator()(float u, float v) const;

    static constexpr float least = 0.125f;  ///< no channel is changed by more

 private:
    /// A channel's factor, and the variance of that of luminance.
    struct Factor {
        Rgb value{1.0f, 1.0f, 1.0f};
        double variance = 0.0;
    };
    using Weights = std::vector<double>;  ///< of cells by their distance on one axis

    static Factor factor_near(const Image<Rgb>& estimate, const Image<Rgb>& truth,
                              const Weights& by_column, const Weights& by_row, std::uint32_t x,
                              std::uint32_t y);
    static float ratio(double truth, double estimate) {
        if (!(truth > 0.0 && estimate > 0.0)) return 1.0f;
        return std::clamp(static_cast<float>(truth / estimate), least, 1.0f / least);
    }
    /// `base` and what of the difference to `factor` is no noise.
    static Rgb shrunk(const Factor& factor, Rgb base) {
        const double off =
            static_cast<double>(luminance(factor.value)) - static_cast<double>(luminance(base));
        const double kept = off == 0.0 ? 0.0 : std::max(1.0 - factor.variance / (off * off), 0.0);
        return base + (factor.value - base) * static_cast<float>(kept);
    }
    static Weights gauss(std::uint32_t cells, double sigma) {
        Weights weights(cells);
        for (std::uint32_t d = 0; d < cells; ++d)
            weights[d] = std::exp(-0.5 * d * d / (sigma * sigma));
        return weights;
    }

    Image<Rgb> factors_;
};

template <Executor E>
LightCorrection::LightCorrection(const Image<Rgb>& estimate, const Image<Rgb>& truth, E& executor)
    : factors_(estimate.extent()) {
    const std::uint32_t width = estimate.width();
    const std::uint32_t height = estimate.height();
    const Rgb all =
        shrunk(factor_near(estimate, truth, Weights(width, 1.0), Weights(height, 1.0), 0, 0),
               {1.0f, 1.0f, 1.0f});
    // A tenth of the shorter side: some hundred cells of two thousand have weight.
    const double sigma = 0.1 * std::min(width, height);
    const Weights by_column = gauss(width, sigma);
    const Weights by_row = gauss(height, sigma);
    executor.for_each(height, [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < width; ++x)
            factors_(x, y) = shrunk(factor_near(estimate, truth, by_column, by_row, x, y), all);
    });
}

inline LightCorrection::Factor LightCorrection::factor_near(const Image<Rgb>& estimate,
                                                            const Image<Rgb>& truth,
                                                            const Weights& by_column,
                                                            const Weights& by_row, std::uint32_t x,
                                                            std::uint32_t y) {
    double e[4] = {}, t[4] = {};                          // red, green, blue, luminance
    double squares_e = 0.0, squares_t = 0.0, both = 0.0;  // of luminances, weights squared
    for (std::uint32_t j = 0; j < estimate.height(); ++j) {
        const double w_row = by_row[j > y ? j - y : y - j];
        for (std::uint32_t i = 0; i < estimate.width(); ++i) {
            const double w = w_row * by_column[i > x ? i - x : x - i];
            const Rgb a = estimate(i, j);
            const Rgb b = truth(i, j);
            const double of_a[] = {a.r, a.g, a.b, luminance(a)};
            const double of_b[] = {b.r, b.g, b.b, luminance(b)};
            for (int c = 0; c < 4; ++c) e[c] += w * of_a[c], t[c] += w * of_b[c];
            squares_e += w * w * of_a[3] * of_a[3];
            squares_t += w * w * of_b[3] * of_b[3];
            both += w * w * of_a[3] * of_b[3];
        }
    }
    if (!(e[3] > 0.0)) return {};
    const double f = t[3] / e[3];
    const double rest = squares_t - 2.0 * f * both + f * f * squares_e;
    return {{ratio(t[0], e[0]), ratio(t[1], e[1]), ratio(t[2], e[2])}, rest / (e[3] * e[3])};
}

inline Rgb LightCorrection::operator()(float u, float v) const {
    const auto place = [](float at, std::uint32_t cells) {
        return std::clamp(at * static_cast<float>(cells) - 0.5f, 0.0f,
                          static_cast<float>(cells - 1));
    };
    const float x = place(u, factors_.width());
    const float y = place(v, factors_.height());
    const auto left = static_cast<std::uint32_t>(x);
    const auto top = static_cast<std::uint32_t>(y);
    const std::uint32_t right = std::min(left + 1, factors_.width() - 1);
    const std::uint32_t bottom = std::min(top + 1, factors_.height() - 1);
    const float s = x - static_cast<float>(left);
    const float t = y - static_cast<float>(top);
    const auto along = [&](std::uint32_t row) {
        return factors_(left, row) * (1.0f - s) + factors_(right, row) * s;
    };
    return along(top) * (1.0f - t) + along(bottom) * t;
}

}  // namespace mir
