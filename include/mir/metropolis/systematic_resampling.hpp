// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mir {

/// Uniform number of [0, 1) with 48 bits from two of `Random`. Each has 24: among 10^5 weights, one
/// of 24 bits would favour some of equal ones by more than 0.1 %.
constexpr double fine_uniform(float coarse, float fine) {
    return static_cast<double>(coarse) + 0x1p-24 * static_cast<double>(fine);
}

/// `count` indices, drawn in proportion to the weights. i is among them count * w_i / sum(w) times
/// on average over `u`, and for no `u` more than one time above or below that. Draw c stands at u +
/// c / count on the circle of all weights in their order: since the whole circle turns with `u`,
/// uniform in [0, 1), each draw by itself has the probabilities w_i / sum(w) too, and may seed a
/// chain of any length.
/// @throws Error(invalid_argument) when a weight is negative or not finite, or none is positive.
/// Source: Carpenter, Clifford, Fearnhead 1999, "Improved particle filter for nonlinear problems".
inline std::vector<std::uint32_t> systematic_resampling(std::span<const double> weights,
                                                        std::uint32_t count, double u) {
    std::vector<double> cumulative;
    cumulative.reserve(weights.size());
    double sum = 0.0;
    for (double w : weights) {
        expects(w >= 0.0 && std::isfinite(w),
                "a weight to resample by is negative or not finite; check what it was computed "
                "from");
        cumulative.push_back(sum += w);
    }
    expects(sum > 0.0 && std::isfinite(sum),
            "the weights to resample by are all zero, or their sum is not finite (nothing can be "
            "chosen); draw more samples or scale the weights");
    // Positions that round up to the sum belong to the last index with weight.
    const auto last = std::lower_bound(cumulative.begin(), cumulative.end(), sum);
    std::vector<std::uint32_t> chosen;
    chosen.reserve(count);
    for (std::uint32_t c = 0; c < count; ++c) {
        const double turn = u + static_cast<double>(c) / count;
        const double position = (turn < 1.0 ? turn : turn - 1.0) * sum;
        const auto found = std::upper_bound(cumulative.begin(), last, position);
        chosen.push_back(static_cast<std::uint32_t>(found - cumulative.begin()));
    }
    return chosen;
}

}  // namespace mir
