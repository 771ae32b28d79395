// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace mir {

/// A share of some light, 0..1, and how well it is known.
struct ShareEstimate {
    double share = 0.0;           ///< 0 where there is no light
    double standard_error = 0.0;  ///< of `share`
};

/// The share of `part` in part + rest, each summed over places. Places are chosen independently of
/// each other and alike; both have as many elements as there are places. The error is that of a
/// ratio of means to first order (Cochran, "Sampling techniques", 1977, chapter 6): it counts how
/// far the parts of single places lie from the same share of their light.
inline ShareEstimate share_estimate(std::span<const double> part, std::span<const double> rest) {
    double parts = 0.0;
    double whole = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        parts += part[i];
        whole += part[i] + rest[i];
    }
    if (!(whole > 0.0)) return {};
    const double share = parts / whole;
    double squares = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const double off = part[i] - share * (part[i] + rest[i]);
        squares += off * off;
    }
    const auto n = static_cast<double>(part.size());
    return {share, n > 1.0 ? std::sqrt(squares * n / (n - 1.0)) / whole : 0.0};
}

}  // namespace mir
