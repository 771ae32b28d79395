// SPDX-License-Identifier: MIT
// Expectations of whole estimators, start and stop of the chain included, by exact enumeration.
#include "metropolis/exact_chain.hpp"
#include "mir/metropolis/acceptance.hpp"
#include "mir/metropolis/systematic_resampling.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace {

using Weights = std::vector<double>;
using mirtest::after_step;
using mirtest::TransitionMatrix;

/// Moves to a neighbour on a circle of states with probability 2/3, anywhere with 1/6.
TransitionMatrix metropolis_chain(const Weights& target) {
    const std::size_t n = target.size();
    TransitionMatrix p = mirtest::no_transitions(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            if (i == j || target[i] == 0.0) continue;
            const bool neighbour = j == (i + 1) % n || i == (j + 1) % n;
            const double proposed =
                (neighbour ? 1.0 / 3 : 0.0) + 1.0 / (6.0 * static_cast<double>(n));
            p[i][j] = proposed * mir::acceptance(target[i], target[j]);
        }
    return mirtest::completed(p);
}

double sum_of(const Weights& w) { return std::accumulate(w.begin(), w.end(), 0.0); }

/// Sum of |a - b| over the sum of b.
double relative_deviation(const Weights& a, const Weights& b) {
    double deviation = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) deviation += std::fabs(a[i] - b[i]);
    return deviation / sum_of(b);
}

// ------------------------------------------------------------------------------------- start-up

/// Contributions of the cells of primary sample space: mostly dim or dark, one far brighter. Whole
/// numbers, so that midpoints stand for all numbers that choose the seed.
const Weights heavy = {0, 0, 1, 2, 30};
constexpr std::size_t bootstrap_paths = 4;

enum class Start {
    same_set,           // P_c is the mean of the set that the seed was chosen from
    independent_scale,  // P_c comes from elsewhere: its expectation
    retried,            // a set without light is drawn again, silently
    brightest_path      // the seed is the brightest path of the set
};

/// E[P_c 1(X_0 = cell)] for chain `c` of `chains`, over all bootstrap sets and seeds.
Weights scaled_start(Start start, std::uint32_t chains, std::uint32_t c) {
    const auto n = heavy.size();
    const double set_probability = std::pow(1.0 / static_cast<double>(n), bootstrap_paths);
    Weights expectation(n);
    double with_light = 0.0;
    mirtest::for_each_tuple(n, bootstrap_paths, [&](const std::vector<std::size_t>& set) {
        Weights weights;
        for (std::size_t cell : set) weights.push_back(heavy[cell]);
        const double sum = sum_of(weights);
        if (sum == 0.0) return;  // P_c is 0: nothing is added
        with_light += set_probability;
        const double scale = start == Start::independent_scale
                                 ? sum_of(heavy) / static_cast<double>(n)
                                 : sum / static_cast<double>(bootstrap_paths);
        const int numbers = static_cast<int>(sum) * static_cast<int>(chains);
        for (int k = 0; k < numbers; ++k) {
            std::size_t seed = mir::systematic_resampling(weights, chains, (k + 0.5) / numbers)[c];
            if (start == Start::brightest_path)
                seed = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) -
                                                weights.begin());
            expectation[set[seed]] += set_probability * scale / numbers;
        }
    });
    if (start == Start::retried || start == Start::independent_scale)
        for (double& e : expectation) e /= with_light;
    return expectation;
}

/// Deviation of E[P_c 1(X_i = cell)] from the integral of f over the cell, after `steps` steps.
double start_up_bias(Start start, int steps, std::uint32_t chains = 1, std::uint32_t c = 0) {
    Weights expectation = scaled_start(start, chains, c);
    const TransitionMatrix p = metropolis_chain(heavy);
    for (int i = 0; i < steps; ++i) expectation = after_step(expectation, p);
    Weights integrals = heavy;
    for (double& f : integrals) f /= static_cast<double>(heavy.size());
    return relative_deviation(expectation, integrals);
}

// ------------------------------------------------------------------------------------- stopping

/// States are pairs of a geometric VPL and one of two suffixes: state / 2 is the geometric VPL.
const Weights paths = {4, 2, 1, 1, 0.5, 3};
constexpr std::size_t geometric_vpls = 3;

enum class Stop {
    at_new_vpl,       // the paper's rule: with the record of the N-th new geometric VPL
    before_next_vpl,  // after all records of the N-th new one
    fixed             // after N records
};

/// The chain, started in its target, until it stops: exact probabilities of (new geometric VPLs so
/// far, state, records of one geometric VPL), record after record.
class StoppedChain {
 public:
    StoppedChain(Stop stop, std::size_t limit, std::size_t wanted)
        : stop_(stop),
          limit_(limit),
          wanted_(wanted),
          longest_(stop == Stop::fixed ? limit : 30 * (limit + 1)),
          now_(size()),
          next_(size()) {}

    /// E[share of the records that are the geometric VPL `wanted`].
    [[nodiscard]] double expected_share() {
        const Weights pi = mirtest::normalised(paths);
        for (std::size_t s = 0; s < paths.size(); ++s)
            now_[place({0, s, s / 2 == wanted_ ? 1u : 0u})] = pi[s];
        for (records_ = 1; records_ <= longest_; ++records_) {
            for (std::size_t r = 0; r <= limit_; ++r)
                for (std::size_t s = 0; s < paths.size(); ++s)
                    for (std::size_t v = 0; v <= records_; ++v) go_on({r, s, v});
            now_.swap(next_);
            next_.assign(size(), 0.0);
        }
        return expectation_;
    }

 private:
    struct Place {
        std::size_t changes, state, visits;
    };
    [[nodiscard]] std::size_t size() const { return (limit_ + 1) * paths.size() * (longest_ + 1); }
    [[nodiscard]] std::size_t place(const Place& p) const {
        return (p.changes * paths.size() + p.state) * (longest_ + 1) + p.visits;
    }
    void end(double probability, std::size_t visits) {
        expectation_ += probability * static_cast<double>(visits) / static_cast<double>(records_);
    }

    void go_on(const Place& from) {
        const double probability = now_[place(from)];
        if (probability == 0.0) return;
        const bool last = stop_ == Stop::fixed
                              ? records_ == limit_
                              : stop_ == Stop::at_new_vpl && from.changes == limit_;
        if (last) return end(probability, from.visits);
        for (std::size_t t = 0; t < paths.size(); ++t) {
            const bool change = stop_ != Stop::fixed && t / 2 != from.state / 2;
            const double p = probability * transitions_[from.state][t];
            if (change && from.changes == limit_)
                end(p, from.visits);
            else if (records_ < longest_)
                next_[place({from.changes + (change ? 1 : 0), t,
                             from.visits + (t / 2 == wanted_ ? 1 : 0)})] += p;
        }
    }

    Stop stop_;
    std::size_t limit_, wanted_;
    std::size_t longest_;  // a longer list of records is too unlikely to matter
    std::size_t records_ = 0;
    double expectation_ = 0.0;
    TransitionMatrix transitions_ = metropolis_chain(paths);
    std::vector<double> now_, next_;
};

double stopping_bias(Stop stop, std::size_t limit) {
    Weights shares, expected(geometric_vpls);
    for (std::size_t v = 0; v < geometric_vpls; ++v)
        shares.push_back(StoppedChain(stop, limit, v).expected_share());
    for (std::size_t s = 0; s < paths.size(); ++s) expected[s / 2] += paths[s] / sum_of(paths);
    CHECK(sum_of(shares) == mirtest::Approx(1.0).epsilon(1e-9));  // every chain has stopped
    return relative_deviation(shares, expected);
}

}  // namespace

TEST_CASE("with P_c from the set that seeds the chain every step is unbiased") {
    for (int steps : {0, 1, 3, 30}) {
        CAPTURE(steps);
        CHECK(start_up_bias(Start::same_set, steps) < 1e-12);
    }
}

TEST_CASE("each of several chains with common P_c is unbiased by itself") {
    for (std::uint32_t c = 0; c < 3; ++c) CHECK(start_up_bias(Start::same_set, 2, 3, c) < 1e-12);
}

TEST_CASE("other ways to start are biased, and stay so for many steps") {
    CHECK(start_up_bias(Start::independent_scale, 0) > 0.3);
    CHECK(start_up_bias(Start::independent_scale, 3) > 0.2);
    CHECK(start_up_bias(Start::independent_scale, 10) > 0.03);
    CHECK(start_up_bias(Start::brightest_path, 0) > 0.01);
    for (int steps : {0, 3, 30}) CHECK(start_up_bias(Start::retried, steps) > 0.02);
}

TEST_CASE("a fixed number of records is unbiased") {
    for (std::size_t n : {1u, 2u, 10u, 50u}) CHECK(stopping_bias(Stop::fixed, n) < 1e-12);
}

TEST_CASE("stopping at the N-th new geometric VPL is biased, by a share that falls like 1 / N") {
    const double at_3 = stopping_bias(Stop::at_new_vpl, 3);
    const double at_6 = stopping_bias(Stop::at_new_vpl, 6);
    const double at_12 = stopping_bias(Stop::at_new_vpl, 12);
    CHECK(at_3 > 0.02);
    CHECK(at_6 < at_3);
    CHECK(at_6 / at_12 == mirtest::Approx(2.0).epsilon(0.2));
    CHECK(stopping_bias(Stop::before_next_vpl, 3) > 0.02);
}
