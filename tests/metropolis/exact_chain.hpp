// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace mirtest {

/// Probabilities P[i][j] of going from state i to state j.
using TransitionMatrix = std::vector<std::vector<double>>;

inline TransitionMatrix no_transitions(std::size_t states) {
    TransitionMatrix p(states, std::vector<double>(states));
    return p;
}

/// Lets every state keep the probability that its row lacks to 1: rejected proposals.
inline TransitionMatrix completed(TransitionMatrix p) {
    for (std::size_t i = 0; i < p.size(); ++i)
        p[i][i] += 1.0 - std::accumulate(p[i].begin(), p[i].end(), 0.0);
    return p;
}

/// First kernel with probability `share`, second otherwise; `share` may depend on the state.
template <class Share>
TransitionMatrix mixture(const TransitionMatrix& a, const TransitionMatrix& b, const Share& share) {
    TransitionMatrix p = no_transitions(a.size());
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < p.size(); ++j)
            p[i][j] = share(i) * a[i][j] + (1 - share(i)) * b[i][j];
    return p;
}

inline std::vector<double> normalised(std::vector<double> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& w : weights) w /= sum;
    return weights;
}

/// Distribution of the state after a step from `from`.
inline std::vector<double> after_step(const std::vector<double>& from, const TransitionMatrix& p) {
    std::vector<double> to(from.size());
    for (std::size_t i = 0; i < from.size(); ++i)
        for (std::size_t j = 0; j < from.size(); ++j) to[j] += from[i] * p[i][j];
    return to;
}

/// Largest |pi_i P_ij - pi_j P_ji|: 0 when the chain is in detailed balance with `target`, of any
/// scale. A negative probability counts as an imbalance of 1.
inline double imbalance(const std::vector<double>& target, const TransitionMatrix& p) {
    const std::vector<double> wanted = normalised(target);
    double worst = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < p.size(); ++j) {
            if (p[i][j] < -1e-14) return 1.0;
            worst = std::max(worst, std::fabs(wanted[i] * p[i][j] - wanted[j] * p[j][i]));
        }
    return worst;
}

/// Total variation distance between `target` and what the chain converges to from it.
inline double stationary_error(const std::vector<double>& target, const TransitionMatrix& p) {
    const std::vector<double> wanted = normalised(target);
    std::vector<double> now = wanted;
    for (int step = 0; step < 10'000; ++step) now = after_step(now, p);
    double distance = 0.0;
    for (std::size_t i = 0; i < wanted.size(); ++i) distance += 0.5 * std::fabs(now[i] - wanted[i]);
    return distance;
}

/// Calls f(tuple) for each of the `states`^`length` tuples of states.
template <class F>
void for_each_tuple(std::size_t states, std::size_t length, const F& f) {
    std::vector<std::size_t> tuple(length);
    while (true) {
        f(static_cast<const std::vector<std::size_t>&>(tuple));
        std::size_t digit = 0;
        while (digit < length && ++tuple[digit] == states) tuple[digit++] = 0;
        if (digit == length) return;
    }
}

}  // namespace mirtest
