// SPDX-License-Identifier: MIT
#include "mir/metropolis/diagnostics.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <cmath>
#include <limits>

using mir::Traces;
using mirtest::Approx;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two independent normal numbers (Box and Muller).
mir::Vec2 normals(mir::Random& random) {
    const mir::Vec2 u = random.next_2d();
    const float r = std::sqrt(-2.0f * std::log(1.0f - u.x));
    return {r * std::cos(2 * mir::pi * u.y), r * std::sin(2 * mir::pi * u.y)};
}

/// Chains of x' = phi x + noise with variance 1, started in it: autocorrelation phi^t, hence the
/// time (1 + phi) / (1 - phi).
Traces autoregressive(double phi, std::size_t chains, std::size_t steps, std::uint64_t index = 0) {
    Traces traces(chains);
    for (std::size_t c = 0; c < chains; ++c) {
        mir::Random random(41, mir::Stream::test, index * 1000 + c);
        double x = static_cast<double>(normals(random).x);
        for (std::size_t i = 0; i < steps; ++i) {
            traces[c].push_back(x);
            x = phi * x + std::sqrt(1 - phi * phi) * static_cast<double>(normals(random).x);
        }
    }
    return traces;
}

Traces shifted(Traces traces, double drift, double offset) {
    for (std::size_t c = 0; c < traces.size(); ++c)
        for (std::size_t i = 0; i < traces[c].size(); ++i)
            traces[c][i] += drift * static_cast<double>(i) / static_cast<double>(traces[c].size()) +
                            offset * static_cast<double>(c);
    return traces;
}

/// Ratio of variances that does not cut the chains in halves.
double unsplit_r_hat(const Traces& traces) {
    mirtest::Moments means;
    double within = 0.0;
    for (const auto& chain : traces) {
        mirtest::Moments m;
        for (double x : chain) m.add(x);
        means.add(m.mean());
        within += m.variance() / static_cast<double>(traces.size());
    }
    return std::sqrt(1.0 + means.variance() / within);
}

double every_step_counts(const Traces& traces) {
    return static_cast<double>(traces.size() * traces[0].size());
}

/// p-value of "means of chains vary as the effective sample size says": squares of the means of 300
/// runs times effective sizes, whose sum is chi-square to the accuracy of the latter.
template <class EffectiveSize>
double size_p_value(const EffectiveSize& effective_size) {
    constexpr int runs = 300;
    double statistic = 0.0;
    for (std::uint64_t run = 0; run < runs; ++run) {
        const Traces traces = autoregressive(0.8, 4, 1000, run);
        mirtest::Moments all;
        for (const auto& chain : traces)
            for (double x : chain) all.add(x);
        statistic += all.mean() * all.mean() * effective_size(traces);
    }
    const double upper = mirtest::chi_square_tail(statistic, runs);
    return 2 * std::fmin(upper, 1 - upper);
}

}  // namespace

TEST_CASE("split R-hat of a small example is the formula's value") {
    // Halves 1 2 | 3 4 | 2 3 | 4 5: W = 1/2, B / n = 5/3, var+ = W / 2 + 5/3.
    const Traces traces{{1, 2, 3, 4}, {2, 3, 4, 5}};
    CHECK(mir::split_r_hat(traces) == Approx(std::sqrt((0.25 + 5.0 / 3) / 0.5)).epsilon(1e-12));
    // The middle of an odd length belongs to no half; what a longer chain has more is not looked
    // at.
    CHECK(mir::split_r_hat({{1, 2, 99, 3, 4}, {2, 3, 99, 4, 5, 1000}}) ==
          Approx(mir::split_r_hat(traces)).epsilon(1e-12));
}

TEST_CASE("autocorrelation time of a small example is the formula's value") {
    // Halves 0 0 0 1 1 1, twice: W = 3/10, var+ = 1/4; rho_t of a half are 1, 1/2, 0, -1/2. So the
    // first pair is 1 + (1 - (3/10 - 3/20) 4) = 7/5, the second negative, and the time -1 + 2
    // (7/5).
    const Traces traces{{0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1}};
    CHECK(mir::autocorrelation_time(traces) == Approx(1.8).epsilon(1e-12));
    CHECK(mir::effective_sample_size(traces) == Approx(12 / 1.8).epsilon(1e-12));
    // From rational arithmetic. The second pair would be larger than the first: without making the
    // sequence monotone the time would be 223/117.
    CHECK(mir::autocorrelation_time({{3, 0, 3, 1, 2, 4, 2, 5, 2, 3}}) ==
          Approx(217.0 / 117).epsilon(1e-12));
}

TEST_CASE("chains that agree have an R-hat near 1") {
    CHECK(mir::split_r_hat(autoregressive(0.0, 4, 4000)) == Approx(1.0).margin(0.005));
    CHECK(mir::split_r_hat(autoregressive(0.9, 8, 20'000)) == Approx(1.0).margin(0.01));
}

TEST_CASE("chains that stay apart or drift together are told by split R-hat") {
    const Traces good = autoregressive(0.0, 4, 1000);
    CHECK(mir::split_r_hat(shifted(good, 0.0, 1.0)) > 1.2);
    CHECK(mir::split_r_hat(shifted(good, 2.0, 0.0)) > 1.1);
    CHECK(unsplit_r_hat(shifted(good, 2.0, 0.0)) < 1.01);  // halves are what tells a common drift
    CHECK(mir::effective_sample_size(shifted(good, 0.0, 1.0)) < 40);
}

TEST_CASE("autocorrelation time and effective sample size do not depend on unit and origin") {
    const Traces traces = autoregressive(0.7, 3, 500);
    Traces other = traces;
    for (auto& chain : other)
        for (double& x : chain) x = 1e-30 * (x + 5);
    CHECK(mir::autocorrelation_time(other) ==
          Approx(mir::autocorrelation_time(traces)).epsilon(1e-6));
    CHECK(mir::split_r_hat(other) == Approx(mir::split_r_hat(traces)).epsilon(1e-6));
}

TEST_CASE("autoregressive chains have the known autocorrelation time", "[statistical]") {
    // 160 000 steps: relative standard errors of the estimate stay below 4 %. Seed 41.
    for (double phi : {0.0, 0.5, 0.9}) {
        const Traces traces = autoregressive(phi, 8, 20'000);
        CAPTURE(phi);
        CHECK(mir::autocorrelation_time(traces) == Approx((1 + phi) / (1 - phi)).epsilon(0.1));
        CHECK(mir::effective_sample_size(traces) ==
              Approx(160'000 * (1 - phi) / (1 + phi)).epsilon(0.1));
    }
    CHECK(mir::autocorrelation_time(autoregressive(-0.5, 8, 20'000)) == 1.0);
}

// H0: mean^2 times effective size is chi-square with 1 degree of freedom; sum over 300 runs, two-
// sided at 1 %, seed 41. Counting every step as independent is rejected at 1e-6.
TEST_CASE("means vary as the effective sample size says", "[statistical]") {
    CHECK(size_p_value([](const Traces& t) { return mir::effective_sample_size(t); }) > 0.01);
    CHECK(size_p_value(every_step_counts) < 1e-6);
}

TEST_CASE("the edges are defined") {
    struct Edge {
        Traces traces;
        double r_hat, time, size;
    };
    const std::vector<Edge> edges = {
        {{}, infinity, 0, 0},                            // no chain
        {{{}, {}}, infinity, 0, 0},                      // no step
        {{{1}}, infinity, 1, 1},                         // too short
        {{{1, 2, 3}, {4, 5, 6}}, infinity, 3, 2},        // too short: one draw per chain
        {{{1, 2, 3}, {4, 5, 6, 7, 8}}, infinity, 3, 2},  // the shortest chain counts
        {{{0.1, 0.1, 0.1, 0.1, 0.1, 0.1}}, 1, 1, 6},     // a constant scalar is known exactly
        {{{7, 7, 7, 7}, {7, 7, 7, 7}}, 1, 1, 8},         //
        {{{0.1, 0.1, 0.1, 0.1}, {3, 3, 3, 3}}, infinity, 4, 2},  // chains that never moved
        {{{1e139, -1e139, 1e139, -1e139}}, std::sqrt(0.5), 1, 4},
        {{{1e-200, 2e-200, 3e-200, 4e-200}}, 1, 1, 4},  // squares vanish: as good as constant
    };
    for (const Edge& e : edges) {
        CAPTURE(&e - edges.data());
        CHECK(mir::split_r_hat(e.traces) == e.r_hat);
        CHECK(mir::autocorrelation_time(e.traces) == e.time);
        CHECK(mir::effective_sample_size(e.traces) == e.size);
    }
}

TEST_CASE("traces that are not finite are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (double bad : {nan, infinity, -infinity, 1e200}) {
        const Traces traces{{1, 2, 3, bad}};
        CHECK_THROWS_AS(mir::split_r_hat(traces), mir::Error);
        CHECK_THROWS_AS(mir::effective_sample_size(traces), mir::Error);
    }
}

TEST_CASE("the scalar that mixes worst is the one reported") {
    const std::vector<Traces> scalars{autoregressive(0.0, 4, 2000), autoregressive(0.9, 4, 2000),
                                      shifted(autoregressive(0.0, 4, 2000), 0.0, 0.5)};
    const mir::Mixing worst = mir::worst_mixing(scalars);
    CHECK(worst.split_r_hat == mir::split_r_hat(scalars[2]));
    CHECK(worst.effective_sample_size == mir::effective_sample_size(scalars[2]));
    CHECK(worst.autocorrelation_time == mir::autocorrelation_time(scalars[2]));
    CHECK(mir::worst_mixing({scalars.data(), 2}).autocorrelation_time ==
          mir::autocorrelation_time(scalars[1]));
    CHECK(mir::worst_mixing({}).effective_sample_size == 0.0);
    CHECK(mir::worst_mixing({}).split_r_hat == infinity);
}
