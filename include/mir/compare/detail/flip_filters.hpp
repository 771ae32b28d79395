// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/detail/separable_filter.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace mir::detail {

/// f(-radius) .. f(radius).
template <class F>
std::vector<double> sampled(int radius, const F& f) {
    std::vector<double> values;
    for (int x = -radius; x <= radius; ++x) values.push_back(f(static_cast<double>(x)));
    return values;
}

/// The filters of FLIP for a number of pixels per degree. Each is made of functions of one
/// coordinate.
struct FlipFilters {
    FilterWeights achromatic;      ///< contrast sensitivity of Y, across and down, sum 1
    FilterWeights red_green;       ///< of Cx
    FilterWeights blue_yellow[2];  ///< of Cz, the sum of two Gaussians
    float blue_yellow_share[2];    ///< weights of these; they add up to 1
    FilterWeights smooth;          ///< Gaussian of the feature detectors, sum 1
    FilterWeights edge;            ///< its first derivative
    FilterWeights point;           ///< its second derivative

    explicit FlipFilters(double pixels_per_degree) {
        make_contrast(pixels_per_degree);
        make_features(pixels_per_degree);
    }

 private:
    static FilterWeights scaled(const std::vector<double>& values, double positive,
                                double negative) {
        FilterWeights weights;
        for (const double v : values)
            weights.push_back(static_cast<float>(v / (v < 0.0 ? negative : positive)));
        return weights;
    }

    static double sum_of(const std::vector<double>& values) {
        double sum = 0.0;
        for (const double v : values) sum += v;
        return sum;
    }

    /// Divides so that positive values add up to 1 and negative ones to -1.
    static FilterWeights balanced(const std::vector<double>& values) {
        double positive = 0.0;
        double negative = 0.0;
        for (const double v : values) (v < 0.0 ? negative : positive) += std::fabs(v);
        return scaled(values, positive, negative);
    }

    /// Contrast sensitivity in space. Sums of a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
    void make_contrast(double ppd) {
        constexpr double pi2 = 9.869604401089358;
        constexpr double widest = 0.04;
        const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(widest / (2.0 * pi2)) * ppd));
        const auto gaussian = [&](double b) {
            return sampled(radius,
                           [&](double x) { return std::exp(-pi2 * x * x / (ppd * ppd * b)); });
        };
        const auto unit = [](const std::vector<double>& g) { return scaled(g, sum_of(g), 1.0); };
        achromatic = unit(gaussian(0.0047));
        red_green = unit(gaussian(0.0053));
        constexpr double a[2] = {34.1, 13.5};
        constexpr double b[2] = {0.04, 0.025};
        double volume[2];
        for (std::size_t i = 0; i < 2; ++i) {
            const std::vector<double> g = gaussian(b[i]);
            blue_yellow[i] = unit(g);
            volume[i] = a[i] / std::sqrt(b[i]) * sum_of(g) * sum_of(g);
        }
        for (std::size_t i = 0; i < 2; ++i)
            blue_yellow_share[i] = static_cast<float>(volume[i] / (volume[0] + volume[1]));
    }

    /// Derivatives of a Gaussian as wide as the eye's edge detectors, 0.082
    /// degrees.
    void make_features(double ppd) {
        const double sd = 0.5 * 0.082 * ppd;
        const int radius = static_cast<int>(std::ceil(3.0 * sd));
        const auto g = [&](double x) { return std::exp(-x * x / (2.0 * sd * sd)); };
        smooth = balanced(sampled(radius, g));
        edge = balanced(sampled(radius, [&](double x) { return -x * g(x); }));
        point =
            balanced(sampled(radius, [&](double x) { return (x * x / (sd * sd) - 1.0) * g(x); }));
    }
};

}  // namespace mir::detail
