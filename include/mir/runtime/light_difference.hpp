// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace mir {

/// How far an estimate of light lies from the truth, over mean light.
struct LightDifference {
    double mean = 0.0;            ///< 0.05: 5 % too bright in the mean
    double standard_error = 0.0;  ///< of `mean`
    double spread = 0.0;          ///< root mean square over places, noise of the estimate included
};

/// The difference between `estimate` and a light known by two unbiased estimates. These are `first`
/// and `second`, independent of Without light it is zero. The standard error is that of a ratio of
/// means to first order (Cochran, "Sampling techniques", 1977, chapter 6). The spread is the root
/// of the mean of (estimate - first) (estimate - second), in which the noise of those two has no
/// part.
inline LightDifference light_difference(std::span<const double> estimate,
                                        std::span<const double> first,
                                        std::span<const double> second) {
    const auto truth = [&](std::size_t i) { return 0.5 * (first[i] + second[i]); };
    double light = 0.0;
    double off = 0.0;
    double product = 0.0;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        light += truth(i);
        off += estimate[i] - truth(i);
        product += (estimate[i] - first[i]) * (estimate[i] - second[i]);
    }
    if (!(light > 0.0)) return {};
    const double mean = off / light;
    double squares = 0.0;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        const double rest = estimate[i] - truth(i) * (1.0 + mean);
        squares += rest * rest;
    }
    const auto n = static_cast<double>(estimate.size());
    return {mean, n > 1.0 ? std::sqrt(squares * n / (n - 1.0)) / light : 0.0,
            std::sqrt(std::max(product, 0.0) * n) / light};
}

}  // namespace mir
