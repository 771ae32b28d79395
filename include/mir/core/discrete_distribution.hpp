// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mir {

/// Picks an index with probability proportional to its weight, by binary search in the cumulative
/// sum. Indices of weight zero are never picked. Immutable; const use from any thread.
class DiscreteDistribution {
 public:
    DiscreteDistribution() = default;

    /// Weights must be finite and not negative; their sum may be zero (then `empty()`).
    explicit DiscreteDistribution(std::span<const float> weights) {
        cumulative_.reserve(weights.size());
        for (float w : weights) {
            expects(w >= 0.0f && w < std::numeric_limits<float>::infinity(),
                    "a sampling weight is negative or not finite; check the emission that it "
                    "comes from");
            total_ += static_cast<double>(w);
            cumulative_.push_back(total_);
        }
    }

    [[nodiscard]] bool empty() const { return !(total_ > 0.0); }
    [[nodiscard]] double total() const { return total_; }
    [[nodiscard]] std::size_t size() const { return cumulative_.size(); }

    /// Index for u in [0, 1). Must not be empty.
    [[nodiscard]] std::uint32_t sample(float u) const {
        const double target = static_cast<double>(u) * total_;
        auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), target);
        // u close to 1 may round up to the total: step back to the last index with weight.
        if (found == cumulative_.end())
            found = std::lower_bound(cumulative_.begin(), cumulative_.end(), total_);
        return static_cast<std::uint32_t>(found - cumulative_.begin());
    }

    /// Probability with which sample() picks `i`.
    [[nodiscard]] float probability(std::uint32_t i) const {
        const double before = i == 0 ? 0.0 : cumulative_[i - 1];
        return static_cast<float>((cumulative_[i] - before) / total_);
    }

 private:
    std::vector<double> cumulative_;
    double total_ = 0.0;
};

}  // namespace mir
