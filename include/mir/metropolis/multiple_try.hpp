// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/acceptance.hpp"

#include <cstdint>
#include <span>

namespace mir {

/// What one step of multiple-try Metropolis decided.
struct MultipleTry {
    std::uint32_t chosen = 0;  ///< candidate that was chosen, by its weight
    double acceptance = 0.0;   ///< probability with which it was to be accepted
    bool accepted = false;     ///< whether it is the successor; if not, the chain stays
};

namespace detail {

/// Index whose share of the sum contains u in [0, 1). Some weight must be positive.
MIR_HD inline std::uint32_t choose_by_weight(const double* weights, std::uint32_t count, double sum,
                                             double u) {
    double below = 0.0;
    std::uint32_t last = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (weights[i] == 0.0) continue;
        below += weights[i];
        last = i;
        if (u * sum < below) break;
    }
    return last;
}

}  // namespace detail

/// One step of multiple-try Metropolis over independent candidates. They were drawn
/// independently of the current state and of one another, from one density q. With w = f /
/// q the weight of a state, one of the candidates is chosen by weight and accepted with a
/// = min(1, S / (S - w(chosen) + w(current))), S = sum of the candidates' weights: the
/// losers stand in for the way back, which therefore need not be drawn. With one candidate
/// this is Metropolis' rule. Correlated candidates break detailed balance. `choice`,
/// `decision`: two independent uniform numbers of [0, 1). Without weight nothing is
/// accepted.
/// @throws Error(internal) unless w(current) is positive, the others not negative, and all finite;
/// on a device the acceptance is NaN instead.
/// Source: Liu, Liang, Wong, "The multiple-try method and local optimization in Metropolis
/// sampling", JASA 95 (2000); for independent candidates Martino, "A review of multiple try MCMC
/// algorithms", Digital Signal Processing 75 (2018).
MIR_HD inline MultipleTry multiple_try(double current, const double* candidates,
                                       std::uint32_t count, double choice, double decision) {
    using detail::ChainNumber;
    current = detail::checked_positive(current, ChainNumber::current_target);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < count; ++i)
        sum += detail::checked_weight(candidates[i], ChainNumber::target);
    sum = detail::checked_weight(sum, ChainNumber::target);
    MultipleTry result;
    result.acceptance = current - current;  // 0, or NaN
    if (sum == 0.0) return result;
    result.chosen = detail::choose_by_weight(candidates, count, sum, choice);
    double way_back = current;
    for (std::uint32_t i = 0; i < count; ++i)
        if (i != result.chosen) way_back += candidates[i];
    result.acceptance = acceptance(way_back, sum);
    result.accepted = decision < result.acceptance;
    return result;
}
/// The same for candidates in a span.
inline MultipleTry multiple_try(double current, std::span<const double> candidates, double choice,
                                double decision) {
    return multiple_try(current, candidates.data(), static_cast<std::uint32_t>(candidates.size()),
                        choice, decision);
}

}  // namespace mir
