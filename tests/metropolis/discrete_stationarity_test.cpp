// SPDX-License-Identifier: MIT
// Detailed balance of the acceptance rules, by exact enumeration of everything that can happen on a
// few states. A rule is right when |pi_i P_ij - pi_j P_ji| vanishes to rounding.
#include "metropolis/exact_rules.hpp"
#include "support/catch.hpp"

#include <numeric>
#include <vector>

using mirtest::balanced;
using mirtest::broken;
using mirtest::completed;
using mirtest::imbalance;
using mirtest::independent_tries;
using mirtest::loser_reuse;
using mirtest::no_transitions;
using mirtest::single_try;
using mirtest::stationary_error;
using mirtest::target;
using mirtest::TransitionMatrix;
using mirtest::Weights;

namespace {

const TransitionMatrix asymmetric = {
    {0.1, 0.6, 0.2, 0.1}, {0.3, 0.1, 0.1, 0.5}, {0.7, 0.1, 0.1, 0.1}, {0.25, 0.05, 0.4, 0.3}};
const TransitionMatrix symmetric = {
    {0.1, 0.4, 0.3, 0.2}, {0.4, 0.3, 0.1, 0.2}, {0.3, 0.1, 0.5, 0.1}, {0.2, 0.2, 0.1, 0.5}};

/// Generic multiple-try Metropolis (Liu, Liang, Wong 2000) with tries by `t`, drawn backwards too,
/// and weights w(y, x). accept(x, y, forward sum, backward sum) is the probability of acceptance.
template <class W, class Accept>
TransitionMatrix backward_tries(const TransitionMatrix& t, std::size_t tries, const W& w,
                                const Accept& accept) {
    const std::size_t n = t.size();
    TransitionMatrix p = no_transitions(n);
    const auto from = [&](std::size_t x, const std::vector<std::size_t>& drawn) {
        double probability = 1.0;
        for (std::size_t y : drawn) probability *= t[x][y];
        return probability;
    };
    const auto sum = [&](const std::vector<std::size_t>& drawn, std::size_t x) {
        double s = 0.0;
        for (std::size_t y : drawn) s += w(y, x);
        return s;
    };
    for (std::size_t x = 0; x < n; ++x)
        mirtest::for_each_tuple(n, tries, [&](const std::vector<std::size_t>& ahead) {
            const double forward = sum(ahead, x);
            for (std::size_t y : ahead)
                mirtest::for_each_tuple(n, tries - 1, [&](const std::vector<std::size_t>& back) {
                    const double a = accept(x, y, forward, sum(back, y) + w(x, y));
                    p[x][y] += from(x, ahead) * (w(y, x) / forward) * from(y, back) * a;
                });
        });
    return completed(p);
}

/// The rule of the generic variant, by the library's function.
double ratio_of_sums(std::size_t, std::size_t, double forward, double backward) {
    return mir::acceptance(backward, forward);
}

/// The winner judged as if it had been the only candidate.
mir::MultipleTry winner_alone(double current, const Weights& candidates, double choice) {
    mir::MultipleTry step = loser_reuse(current, candidates, choice);
    step.acceptance = mir::acceptance(current, candidates[step.chosen]);
    return step;
}

double sum_of(const Weights& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

/// Barker's rule (1965): the next state chosen by weight among candidates and current state.
mir::MultipleTry barker(double current, const Weights& candidates, double choice) {
    mir::MultipleTry step = loser_reuse(current, candidates, choice);
    step.acceptance = sum_of(candidates) / (sum_of(candidates) + current);
    return step;
}

/// The mean weight of the candidates judged against the current state.
mir::MultipleTry mean_weight(double current, const Weights& candidates, double choice) {
    mir::MultipleTry step = loser_reuse(current, candidates, choice);
    step.acceptance =
        mir::acceptance(current, sum_of(candidates) / static_cast<double>(candidates.size()));
    return step;
}

const Weights whole_weights = {1, 0, 5, 2, 3};
const Weights proposal = {0.3, 0.1, 0.05, 0.4, 0.15};

Weights product(const Weights& a, const Weights& b) {
    Weights c;
    for (std::size_t i = 0; i < a.size(); ++i) c.push_back(a[i] * b[i]);
    return c;
}

}  // namespace

TEST_CASE("Metropolis-Hastings is in detailed balance") {
    const auto hastings = [](const TransitionMatrix& t) {
        return single_try(t, [&t](std::size_t i, std::size_t j) {
            return mir::acceptance(target[i], t[i][j], target[j], t[j][i]);
        });
    };
    CHECK(imbalance(target, hastings(asymmetric)) < balanced);
    CHECK(imbalance(target, hastings(symmetric)) < balanced);
    CHECK(stationary_error(target, hastings(asymmetric)) < balanced);
    const auto metropolis = [](std::size_t i, std::size_t j) {
        return mir::acceptance(target[i], target[j]);
    };
    CHECK(imbalance(target, single_try(symmetric, metropolis)) < balanced);
}

TEST_CASE("wrong Metropolis-Hastings rules are rejected") {
    const auto& t = asymmetric;
    SECTION("the densities of a proposal forgotten") {
        const auto p = single_try(
            t, [](std::size_t i, std::size_t j) { return mir::acceptance(target[i], target[j]); });
        CHECK(imbalance(target, p) > broken);
        CHECK(stationary_error(target, p) > 0.01);
    }
    SECTION("the densities of a proposal exchanged") {
        CHECK(imbalance(target, single_try(t, [&](std::size_t i, std::size_t j) {
                            return mir::acceptance(target[i], t[j][i], target[j], t[i][j]);
                        })) > broken);
    }
    SECTION("the target exchanged") {
        CHECK(imbalance(target, single_try(symmetric, [](std::size_t i, std::size_t j) {
                            return mir::acceptance(target[j], target[i]);
                        })) > broken);
    }
}

TEST_CASE("generic multiple-try is in detailed balance for every symmetric lambda") {
    const auto w = [](auto lambda) {
        return [lambda](std::size_t y, std::size_t x) {
            return target[y] * asymmetric[y][x] * lambda(x, y);
        };
    };
    const auto one = [](std::size_t, std::size_t) { return 1.0; };
    const auto mean = [](std::size_t x, std::size_t y) {
        return 2 / (asymmetric[x][y] + asymmetric[y][x]);
    };
    const auto both = [](std::size_t x, std::size_t y) {
        return 1 / (asymmetric[x][y] * asymmetric[y][x]);
    };
    for (std::size_t tries : {1u, 2u, 3u}) {
        CAPTURE(tries);
        CHECK(imbalance(target, backward_tries(asymmetric, tries, w(one), ratio_of_sums)) <
              balanced);
        CHECK(imbalance(target, backward_tries(asymmetric, tries, w(mean), ratio_of_sums)) <
              balanced);
        CHECK(imbalance(target, backward_tries(asymmetric, tries, w(both), ratio_of_sums)) <
              balanced);
        const auto plain = [](std::size_t y, std::size_t) { return target[y]; };
        CHECK(imbalance(target, backward_tries(symmetric, tries, plain, ratio_of_sums)) < balanced);
    }
}

TEST_CASE("tempting errors of generic multiple-try are rejected") {
    SECTION("w = pi(y) with an asymmetric proposal") {
        const auto plain = [](std::size_t y, std::size_t) { return target[y]; };
        const auto p = backward_tries(asymmetric, 2, plain, ratio_of_sums);
        CHECK(imbalance(target, p) > broken);
        CHECK(stationary_error(target, p) > 0.01);
    }
    SECTION("the ratio of Metropolis and Hastings applied to the winner") {
        const auto& t = asymmetric;
        const auto w = [&](std::size_t y, std::size_t x) { return target[y] * t[y][x]; };
        const auto winner = [&](std::size_t x, std::size_t y, double, double) {
            return mir::acceptance(target[x], t[x][y], target[y], t[y][x]);
        };
        CHECK(imbalance(target, backward_tries(t, 1, w, winner)) < balanced);
        CHECK(imbalance(target, backward_tries(t, 2, w, winner)) > broken);
        CHECK(stationary_error(target, backward_tries(t, 2, w, winner)) > 0.01);
    }
}

TEST_CASE("multiple-try over independent candidates is in detailed balance") {
    for (std::size_t tries : {1u, 2u, 3u, 5u}) {
        CAPTURE(tries);
        const auto p = independent_tries(whole_weights, proposal, tries, loser_reuse);
        CHECK(imbalance(product(whole_weights, proposal), p) < balanced);
    }
}

TEST_CASE("another legal rule over independent candidates passes the same check") {
    const auto p = independent_tries(whole_weights, proposal, 3, barker);
    CHECK(imbalance(product(whole_weights, proposal), p) < balanced);
}

TEST_CASE("more independent candidates leave fewer steps where they were") {
    // Mean probability of staying, in the target.
    const Weights pi = mirtest::normalised(product(whole_weights, proposal));
    double before = 1.0;
    for (std::size_t tries : {1u, 2u, 3u, 5u}) {
        const auto p = independent_tries(whole_weights, proposal, tries, loser_reuse);
        double staying = 0.0;
        for (std::size_t i = 0; i < pi.size(); ++i) staying += pi[i] * p[i][i];
        CHECK(staying < before);
        before = staying;
    }
}

TEST_CASE("wrong rules over independent candidates are rejected") {
    const Weights pi = product(whole_weights, proposal);
    SECTION("Metropolis' ratio applied to the winner") {
        CHECK(imbalance(pi, independent_tries(whole_weights, proposal, 1, winner_alone)) <
              balanced);
        const auto p = independent_tries(whole_weights, proposal, 3, winner_alone);
        CHECK(imbalance(pi, p) > broken);
        CHECK(stationary_error(pi, p) > 0.01);
    }
    SECTION("the mean weight of the candidates against the current state") {
        const auto p = independent_tries(whole_weights, proposal, 3, mean_weight);
        CHECK(imbalance(pi, p) > broken);
    }
    SECTION("weights that are not divided by the proposal's density") {
        CHECK(imbalance(whole_weights, independent_tries(whole_weights, proposal, 3, loser_reuse)) >
              broken);
    }
}
