// SPDX-License-Identifier: MIT
#include "support/statistics.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/kolmogorov.hpp"

namespace {

using mirtest::Approx;
using mirtest::ChiSquare;
using mirtest::Histogram;

mir::Random numbers(std::uint64_t seed) { return {seed, mir::Stream::test, 0}; }

/// Points of density 2x on the unit square.
Histogram ramp(std::uint64_t seed, int count) {
    Histogram h(12, 10);
    mir::Random random = numbers(seed);
    for (int i = 0; i < count; ++i) {
        const double x = std::sqrt(static_cast<double>(random.next()));
        h.add(x, static_cast<double>(random.next()));
    }
    return h;
}

}  // namespace

TEST_CASE("tail probabilities agree with tables") {
    CHECK(mirtest::chi_square_tail(3.841458820694124, 1) == Approx(0.05));
    CHECK(mirtest::chi_square_tail(18.307038053275146, 10) == Approx(0.05));
    CHECK(mirtest::chi_square_tail(135.80672317102676, 100) == Approx(0.01));
    CHECK(mirtest::chi_square_tail(0.0, 7) == 1.0);
    CHECK(mirtest::chi_square_tail(2.0, 2) == Approx(std::exp(-1.0)));
    CHECK(mirtest::chi_square_tail(1000.0, 1000) == Approx(0.4940530).margin(2e-6));
    CHECK(mirtest::normal_tails(1.959963984540054) == Approx(0.05));
    CHECK(mirtest::normal_tails(-2.5758293035489004) == Approx(0.01));
    CHECK(mirtest::student_tails(2.2281388519649385, 10) == Approx(0.05));
    CHECK(mirtest::student_tails(-63.65674116287158, 1) == Approx(0.01));
    CHECK(mirtest::student_tails(0.0, 3) == Approx(1.0));
}

TEST_CASE("Sidak's level makes the family as strict as asked") {
    CHECK(mirtest::sidak(0.01, 1) == Approx(0.01));
    CHECK(1.0 - std::pow(1.0 - mirtest::sidak(0.01, 37), 37) == Approx(0.01));
}

TEST_CASE("quadrature reproduces integrals known in closed form") {
    CHECK(mirtest::integrate(0.0, 2.0, 1, [](double x) { return x * x * x; }) == Approx(4.0));
    CHECK(mirtest::integrate_hemisphere(8, [](mir::Vec3 w) { return w.z; }) == Approx(mirtest::pi));
    CHECK(mirtest::integrate_directions(-1.0, 1.0, 8, [](mir::Vec3) { return 1.0f; }) ==
          Approx(4 * mirtest::pi));
    double sum = 0.0;
    for (double c : mirtest::cell_integrals(5, 7, 1, [](double x, double y) { return 4 * x * y; }))
        sum += c;
    CHECK(sum == Approx(1.0));
}

// H0: density 2x. Level 1e-3 for acceptance at seed 1; wrong densities must be rejected at 1e-6.
TEST_CASE("the chi-square test accepts the right density and rejects wrong ones", "[statistical]") {
    const Histogram points = ramp(1, 20'000);
    const ChiSquare right = points.against([](double x, double) { return 2 * x; });
    CHECK(right.degrees_of_freedom > 100);
    CHECK(right.p_value > 1e-3);
    CHECK(points.against([](double, double) { return 1.0; }).p_value < 1e-6);
    const auto bent = [](double x, double y) { return 2 * x * (1 + 0.1 * (y - 0.5)); };
    CHECK(ramp(1, 200'000).against(bent).p_value < 1e-6);
}

TEST_CASE("the chi-square test rejects a density whose integral is not 1", "[statistical]") {
    // 5 % of the mass is said to lie elsewhere, where nothing falls. Seed 2, rejection at 1e-6.
    const Histogram points = ramp(2, 20'000);
    CHECK(points.against([](double x, double) { return 1.9 * x; }).p_value < 1e-6);
}

TEST_CASE("a count in a cell that expects nothing rejects at once") {
    const ChiSquare result = mirtest::chi_square({50, 50, 1}, {50.5, 50.5, 0});
    CHECK(result.hit_impossible_cell);
    CHECK(result.p_value == 0.0);
    CHECK(mirtest::chi_square({50, 51, 0}, {50.5, 50.5, 0}).p_value > 0.5);
}

TEST_CASE("cells are pooled until each pool expects five") {
    const ChiSquare result = mirtest::chi_square({20, 2, 3, 1, 1}, {20, 3, 2, 1, 1});
    CHECK(result.degrees_of_freedom == 1);  // {20}, {3, 2} with the rest of 2 joined
    CHECK(result.statistic == Approx(0.0).margin(1e-12));
}

// H0: p-values are uniform. Kolmogorov-Smirnov at 1 %: distance below 1.63 / sqrt(300). Seeds 100+.
TEST_CASE("p-values of true hypotheses are uniform", "[statistical]") {
    std::vector<double> chi, mean, welch;
    for (std::uint64_t i = 0; i < 300; ++i) {
        chi.push_back(
            ramp(100 + i, 3000).against([](double x, double) { return 2 * x; }, 1).p_value);
        mir::Random random = numbers(1000 + i);
        mirtest::Moments a, b;
        for (int k = 0; k < 12; ++k) a.add(static_cast<double>(random.next()));
        for (int k = 0; k < 30; ++k) b.add(static_cast<double>(random.next()) * 3.0 - 1.0);
        mean.push_back(mirtest::mean_p_value(a, 0.5));
        welch.push_back(mirtest::welch_p_value(a, b));
    }
    CHECK(mirtest::kolmogorov_distance(chi) < 1.63 / std::sqrt(300.0));
    CHECK(mirtest::kolmogorov_distance(mean) < 1.63 / std::sqrt(300.0));
    CHECK(mirtest::kolmogorov_distance(welch) < 1.63 / std::sqrt(300.0));
}

// H0: the mean is 0.5. True mean 0.52 must be rejected at 1e-6. Seed 3.
TEST_CASE("the test of a mean rejects a wrong mean", "[statistical]") {
    mir::Random random = numbers(3);
    mirtest::Moments m, other;
    for (int i = 0; i < 20'000; ++i) m.add(static_cast<double>(random.next()) + 0.02);
    for (int i = 0; i < 20'000; ++i) other.add(static_cast<double>(random.next()));
    CHECK(mirtest::mean_p_value(m, 0.5) < 1e-6);
    CHECK(mirtest::welch_p_value(m, other) < 1e-6);
    CHECK(m.variance() == Approx(1.0 / 12).epsilon(0.02));
}
