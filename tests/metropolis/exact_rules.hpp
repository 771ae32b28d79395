// SPDX-License-Identifier: MIT
#pragma once

#include "metropolis/exact_chain.hpp"
#include "mir/metropolis/multiple_try.hpp"

namespace mirtest {

/// Of states, of any scale.
using Weights = std::vector<double>;

inline constexpr double balanced = 1e-12;  ///< imbalance() of a right rule is below
inline constexpr double broken = 1e-3;     ///< of a wrong one above

inline const Weights target = {0.1, 0.35, 0.05, 0.5};

/// The chain that proposes by `t` and accepts j after i with rule(i, j).
template <class Rule>
TransitionMatrix single_try(const TransitionMatrix& t, const Rule& rule) {
    TransitionMatrix p = no_transitions(t.size());
    for (std::size_t i = 0; i < t.size(); ++i)
        for (std::size_t j = 0; j < t.size(); ++j)
            if (i != j && t[i][j] > 0.0) p[i][j] = t[i][j] * rule(i, j);
    return completed(p);
}

/// Multiple-try Metropolis with `tries` independent candidates of probabilities `q`. Weights must
/// be whole numbers: the choice then changes only at multiples of 1 / sum, and the midpoints
/// between those stand for every number it may get. rule(w of the current state, weights, number).
template <class Rule>
TransitionMatrix independent_tries(const Weights& w, const Weights& q, std::size_t tries,
                                   const Rule& rule) {
    TransitionMatrix p = no_transitions(w.size());
    mirtest::for_each_tuple(w.size(), tries, [&](const std::vector<std::size_t>& drawn) {
        double probability = 1.0, sum = 0.0;
        Weights weights;
        for (std::size_t y : drawn) {
            probability *= q[y];
            sum += w[y];
            weights.push_back(w[y]);
        }
        for (std::size_t x = 0; x < w.size(); ++x)
            for (int k = 0; k < static_cast<int>(sum) && w[x] > 0.0; ++k) {
                const mir::MultipleTry step = rule(w[x], weights, (k + 0.5) / sum);
                p[x][drawn[step.chosen]] += probability / sum * step.acceptance;
            }
    });
    return completed(p);
}

/// The library's rule.
inline mir::MultipleTry loser_reuse(double current, const Weights& candidates, double choice) {
    return mir::multiple_try(current, candidates, choice, 0.0);
}

}  // namespace mirtest
