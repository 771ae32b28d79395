// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/math.hpp"
#include "mir/core/space.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mir {

/// Index of the first of `count` values that `holds` is true of, found by halving. It must be true
/// of all behind that one. `count` if there is none.
template <class T, class Predicate>
MIR_HD std::uint32_t first_that(const T* values, std::uint32_t count, const Predicate& holds) {
    std::uint32_t first = 0;
    while (count > 0) {
        const std::uint32_t half = count / 2;
        const bool found = holds(values[first + half]);
        first += found ? 0 : half + 1;
        count = found ? half : count - half - 1;
    }
    return first;
}

/// What kernels read of a DiscreteDistribution. A view; thread-safe.
template <Space S>
struct DiscreteDistributionView {
    static constexpr Space space = S;  ///< memory that `cumulative` lies in

    const double* cumulative = nullptr;  ///< sums of the weights up to each index, it included
    std::uint32_t size = 0;              ///< of `cumulative`
    double total = 0.0;                  ///< sum of all weights, finite and at least 0

    /// True when no index has weight: sample() and probability() must not be called.
    [[nodiscard]] MIR_HD bool empty() const { return !(total > 0.0); }

    /// Index for u in [0, 1). Must not be empty.
    [[nodiscard]] MIR_HD std::uint32_t sample(float u) const {
        const double most = total;
        const double wanted = static_cast<double>(u) * most;
        const std::uint32_t found =
            first_that(cumulative, size, [=](double sum) { return sum > wanted; });
        // u close to 1 may round up to the total: step back to the last index with weight.
        return found < size ? found
                            : first_that(cumulative, size, [=](double sum) { return sum >= most; });
    }

    /// Probability with which sample() picks `i`.
    [[nodiscard]] MIR_HD float probability(std::uint32_t i) const {
        const double before = i == 0 ? 0.0 : cumulative[i - 1];
        return static_cast<float>((cumulative[i] - before) / total);
    }

    /// Where `u` lies among the numbers that sample() maps to `i`, in [0, 1). It is uniform when
    /// `u` is and i = sample(u).
    [[nodiscard]] MIR_HD float place_in(std::uint32_t i, float u) const {
        const double before = i == 0 ? 0.0 : cumulative[i - 1];
        const double place = (static_cast<double>(u) * total - before) / (cumulative[i] - before);
        // Rounding may put a number beside its own index.
        return smaller(larger(static_cast<float>(place), 0.0f), 0x1.fffffep-1f);
    }

    /// The number, in [0, 1), that sample() maps to `i` and place_in() to `place`.
    [[nodiscard]] MIR_HD float number_at(std::uint32_t i, float place) const {
        const double before = i == 0 ? 0.0 : cumulative[i - 1];
        const double at = before + static_cast<double>(place) * (cumulative[i] - before);
        return smaller(larger(static_cast<float>(at / total), 0.0f), 0x1.fffffep-1f);
    }
};

/// Picks an index with probability proportional to its weight. By binary search in the cumulative
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

    /// True when no index has weight: sample() and probability() must not be called.
    [[nodiscard]] bool empty() const { return view().empty(); }
    /// Sum of all weights, in their unit.
    [[nodiscard]] double total() const { return total_; }
    /// Number of weights, those of zero included.
    [[nodiscard]] std::size_t size() const { return cumulative_.size(); }

    /// Sums of the weights up to each index, it included.
    [[nodiscard]] std::span<const double> cumulative() const { return cumulative_; }
    /// What kernels on the host read; valid until the distribution is changed or ends.
    [[nodiscard]] DiscreteDistributionView<Space::host> view() const {
        return {cumulative_.data(), static_cast<std::uint32_t>(cumulative_.size()), total_};
    }

    /// Index for u in [0, 1). Must not be empty.
    [[nodiscard]] std::uint32_t sample(float u) const { return view().sample(u); }

    /// Probability with which sample() picks `i`.
    [[nodiscard]] float probability(std::uint32_t i) const { return view().probability(i); }

 private:
    std::vector<double> cumulative_;
    double total_ = 0.0;
};

}  // namespace mir
