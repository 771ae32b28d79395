// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace mir {

/// Values of one scalar along several Markov chains: traces[c][i] is chain c at step i. Where
/// lengths differ, only as many steps as the shortest chain has are looked at.
using Traces = std::vector<std::vector<double>>;

namespace detail {

inline std::size_t common_length(const Traces& traces) {
    std::size_t length = traces.empty() ? 0 : traces[0].size();
    for (const auto& chain : traces) length = std::min(length, chain.size());
    return length;
}

/// Both halves of every chain, as pieces of equal length. The middle of an odd length is left out.
/// A chain that drifts disagrees with itself.
inline std::vector<std::span<const double>> split_halves(const Traces& traces) {
    const std::size_t length = common_length(traces);
    std::vector<std::span<const double>> halves;
    for (const auto& chain : traces) {
        for (double x : chain)
            expects(
                std::fabs(x) < 1e140,
                "a trace of a Markov chain holds a number that is not finite or whose square "
                "is not (its spread cannot be measured); hand in a scalar that every state has");
        const std::span<const double> all(chain.data(), length);
        halves.push_back(all.first(length / 2));
        halves.push_back(all.last(length / 2));
    }
    return halves;
}

/// Relative to the first value. Equal values then have exactly that mean and no variance.
inline double mean(std::span<const double> values) {
    double sum = 0.0;
    for (double x : values) sum += x - values[0];
    return values[0] + sum / static_cast<double>(values.size());
}

/// Sum of (x_i - m)(x_(i + lag) - m) with m the mean of `x`.
inline double autocovariance_sum(std::span<const double> x, double m, std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < x.size(); ++i) sum += (x[i] - m) * (x[i + lag] - m);
    return sum;
}

/// Spread inside and over pieces of chains (BDA3, equations 11.1 to 11.3).
class Spread {
 public:
    /// At least two pieces of one length of at least two.
    explicit Spread(std::vector<std::span<const double>> pieces)
        : pieces_(std::move(pieces)),
          means_(means_of(pieces_)),
          within_(covariance(0)),
          total_(within_ - within_ / static_cast<double>(length()) +
                 autocovariance_sum(means_, mean(means_), 0) / static_cast<double>(count() - 1)) {}

    [[nodiscard]] std::size_t count() const { return pieces_.size(); }
    [[nodiscard]] std::size_t length() const { return pieces_[0].size(); }
    /// W: mean variance of a piece.
    [[nodiscard]] double within() const { return within_; }
    /// var+: variance of the target, too large while the pieces disagree.
    [[nodiscard]] double total() const { return total_; }

    /// Autocorrelation at `lag` with the disagreement of the pieces counted in, rho_t of Vehtari et
    /// al. 2021, equation 10.
    [[nodiscard]] double autocorrelation(std::size_t lag) const {
        return 1.0 - (within_ - covariance(lag)) / total_;
    }

 private:
    static std::vector<double> means_of(const std::vector<std::span<const double>>& pieces) {
        std::vector<double> means;
        means.reserve(pieces.size());
        for (const auto& x : pieces) means.push_back(mean(x));
        return means;
    }

    /// Mean of all pieces of s^2 rho_t. s^2 has the divisor n - 1 at every lag.
    [[nodiscard]] double covariance(std::size_t lag) const {
        double sum = 0.0;
        for (std::size_t p = 0; p < count(); ++p)
            sum += autocovariance_sum(pieces_[p], means_[p], lag);
        return sum / static_cast<double>(count() * (length() - 1));
    }

    std::vector<std::span<const double>> pieces_;
    std::vector<double> means_;
    double within_;
    double total_;
};

}  // namespace detail

/// Split R-hat: the factor by which a scalar's spread might still shrink. It is near 1 once the
/// chains, cut in halves, agree; 1.05 and more is a warning. Defined for every input: infinity when
/// there are no chains or one has fewer than four steps (nothing is known), or when all halves are
/// constant but differ; 1 when all values are equal. The latter cannot tell a constant scalar from
/// a chain that never moved: look at its acceptance too.
/// @throws Error(invalid_argument) when a value is not below 1e140 in magnitude.
/// Source: Gelman et al., "Bayesian Data Analysis", third edition, section 11.4.
inline double split_r_hat(const Traces& traces) {
    auto halves = detail::split_halves(traces);
    if (detail::common_length(traces) < 4) return std::numeric_limits<double>::infinity();
    const detail::Spread spread(std::move(halves));
    return spread.total() == 0.0 ? 1.0 : std::sqrt(spread.total() / spread.within());
}

/// Integrated autocorrelation time 1 + 2 sum(rho_t). How many steps are worth one independent draw
/// of the scalar. At least 1, at most the length of a chain. The sum stops where pairs of
/// neighbouring lags stop being positive and is made monotone, so its length adapts to the data.
/// Defined for every input: 1 when all values are equal; the length of a chain when that is below
/// four (0 without steps) or when all halves are constant but differ. Its cost is proportional to
/// the number of steps times the result.
/// @throws Error(invalid_argument) when a value is not below 1e140 in magnitude.
/// Source: Geyer 1992, "Practical Markov chain Monte Carlo", section 3.3 (initial monotone
/// sequence); over several chains Vehtari et al. 2021, "Rank-normalization, folding, and
/// localization", section 3.2.
inline double autocorrelation_time(const Traces& traces) {
    auto halves = detail::split_halves(traces);
    const auto longest = static_cast<double>(detail::common_length(traces));
    if (longest < 4.0) return longest;
    const detail::Spread spread(std::move(halves));
    if (spread.total() == 0.0) return 1.0;
    if (spread.within() == 0.0) return longest;
    double time = -1.0;
    double pair = std::numeric_limits<double>::infinity();
    for (std::size_t lag = 0; lag + 1 < spread.length(); lag += 2) {
        pair = std::min(pair, spread.autocorrelation(lag) + spread.autocorrelation(lag + 1));
        if (!(pair > 0.0)) break;
        time += 2.0 * pair;
    }
    return std::clamp(time, 1.0, longest);
}

/// Number of independent draws with the variance of the chains' mean. It is their steps over
/// autocorrelation_time(). At least one per chain, 0 without steps.
/// @throws Error(invalid_argument) when a value is not below 1e140 in magnitude.
inline double effective_sample_size(const Traces& traces) {
    const std::size_t draws = traces.size() * detail::common_length(traces);
    return draws == 0 ? 0.0 : static_cast<double>(draws) / autocorrelation_time(traces);
}

/// How well chains mix, judged by the scalar that mixes worst.
struct Mixing {
    double effective_sample_size = 0.0;  ///< independent draws that all chains are worth
    double split_r_hat = std::numeric_limits<double>::infinity();  ///< near 1 is ideal
    double autocorrelation_time = 0.0;  ///< steps of the traces per independent draw
};

/// Worst diagnostics over several scalars of the same chains. They are the smallest effective
/// sample size, largest R-hat and longest autocorrelation time. Without scalars: what is known of
/// chains without steps.
/// @throws Error(invalid_argument) when a value is not below 1e140 in magnitude.
inline Mixing worst_mixing(std::span<const Traces> scalars) {
    Mixing worst;
    for (std::size_t i = 0; i < scalars.size(); ++i) {
        const Mixing m{effective_sample_size(scalars[i]), split_r_hat(scalars[i]),
                       autocorrelation_time(scalars[i])};
        if (i == 0) worst = m;
        worst = {std::min(worst.effective_sample_size, m.effective_sample_size),
                 std::max(worst.split_r_hat, m.split_r_hat),
                 std::max(worst.autocorrelation_time, m.autocorrelation_time)};
    }
    return worst;
}

}  // namespace mir
