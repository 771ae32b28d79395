// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace mirtest {

/// Largest gap between the distribution of numbers and the uniform one on [0, 1].
inline double kolmogorov_distance(std::vector<double> p) {
    std::sort(p.begin(), p.end());
    const auto n = static_cast<double>(p.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i)
        worst = std::max(
            {worst, p[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p[i]});
    return worst;
}

/// p-value of "the numbers are independent and uniform on [0, 1]" (Kolmogorov and Smirnov, with
/// Stephens' correction for few numbers; Press et al., "Numerical Recipes", section 14.3).
inline double uniform_p_value(const std::vector<double>& p) {
    const double root = std::sqrt(static_cast<double>(p.size()));
    const double lambda = (root + 0.12 + 0.11 / root) * kolmogorov_distance(p);
    double sum = 0.0;
    for (int k = 1; k <= 100; ++k)
        sum += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * lambda * lambda);
    // The series oscillates for tiny lambda, where the value is 1.
    return lambda < 0.3 ? 1.0 : std::clamp(sum, 0.0, 1.0);
}

}  // namespace mirtest
