// SPDX-License-Identifier: MIT
#include "mir/metropolis/small_step.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <array>
#include <cmath>
#include <vector>

using mir::SmallStep;

namespace {

constexpr float almost_one = 0x1.fffffep-1f;

/// Number of the same length and opposite direction.
float opposite(float number) { return number < 0.5f ? number + 0.5f : number - 0.5f; }

/// Whether every move is undone, in every bit, by the number of the opposite direction. As all
/// numbers are equally likely, T(u -> v) == T(v -> u) follows for all u and v.
template <class Perturb>
bool is_exactly_symmetric(const Perturb& perturb) {
    mir::Random random(31, mir::Stream::test, 0);
    for (int i = 0; i < 100'000; ++i) {
        const float u = random.next();
        const float number = random.next();
        if (perturb(perturb(u, number), opposite(number)) != u) return false;
    }
    return true;
}

/// Signed length of the way from `u` to `v` around the circle, in (-1/2, 1/2].
double way(float u, float v) {
    const double d = static_cast<double>(v) - static_cast<double>(u);
    return d - std::ceil(d - 0.5);
}

/// Chi-square of 100 000 moves against density 1 / (2 |d| ln(s2 / s1)), over 32 lengths of equal
/// probability on either side; a length outside [s1, s2] falls into a cell that expects nothing.
template <class Perturb>
double kernel_p_value(const Perturb& perturb, double s1, double s2) {
    constexpr int cells = 32, draws = 100'000;
    std::vector<double> observed(2 * cells + 1);
    std::vector<double> expected(2 * cells + 1, draws / (2.0 * cells));
    expected.back() = 0.0;
    mir::Random random(32, mir::Stream::test, 0);
    for (int i = 0; i < draws; ++i) {
        const float u = random.next();
        const double d = way(u, perturb(u, random.next()));
        const double share = std::log(std::fabs(d) / s1) / std::log(s2 / s1);
        const bool inside = share > -1e-3 && share < 1 + 1e-3;  // lengths are rounded to cells
        const int cell = std::min(static_cast<int>(std::fmax(share, 0.0) * cells), cells - 1);
        observed[static_cast<std::size_t>(!inside ? 2 * cells : d > 0 ? cell : cells + cell)] += 1;
    }
    return mirtest::chi_square(observed, expected).p_value;
}

}  // namespace

TEST_CASE("small steps give known answers on any machine") {
    // In units of 2^-24: u, number, moved u. Lengths from decimal arithmetic with 50 digits.
    struct Answer {
        std::uint32_t u, number, moved;
    };
    constexpr std::array<Answer, 6> answers = {{{0, 0, 262'144},
                                                {0, 8'388'608, 16'515'072},
                                                {8'388'608, 1'234'567, 8'562'920},
                                                {16'777'215, 7'654'321, 20'883},
                                                {5'000'000, 9'999'999, 4'846'101},
                                                {123, 16'777'215, 16'760'955}}};
    const SmallStep step;
    for (const Answer& a : answers) {
        CAPTURE(a.u, a.number);
        CHECK(step.perturb(static_cast<float>(a.u) * 0x1p-24f,
                           static_cast<float>(a.number) * 0x1p-24f) ==
              static_cast<float>(a.moved) * 0x1p-24f);
    }
}

TEST_CASE("the portable power of two has a relative error below 1e-8") {
    for (int i = -40'000; i <= 40'000; ++i) {
        const double x = i / 1000.0 + 1e-5;
        REQUIRE(std::fabs(mir::detail::portable_exp2(x) / std::exp2(x) - 1.0) < 1e-8);
    }
    CHECK(mir::detail::portable_exp2(-3.0) == mirtest::Approx(0.125).epsilon(1e-8));
}

TEST_CASE("a small step is exactly symmetric, wrapping included") {
    for (const SmallStep& s : {SmallStep(), SmallStep(0x1p-24f, 0.5f), SmallStep(0.1f, 0.3f)})
        CHECK(is_exactly_symmetric([&](float u, float number) { return s.perturb(u, number); }));
}

TEST_CASE("asymmetric small steps are rejected") {
    const SmallStep s;
    SECTION("always upwards") {
        CHECK_FALSE(is_exactly_symmetric([&](float u, float n) { return s.perturb(u, 0.5f * n); }));
    }
    SECTION("clamped at the border instead of wrapped") {
        CHECK_FALSE(is_exactly_symmetric([&](float u, float n) {
            const auto d = static_cast<float>(way(u, s.perturb(u, n)));
            return std::fmin(std::fmax(u + d, 0.0f), almost_one);
        }));
    }
    SECTION("rounded to single precision instead of the numbers' grid") {
        CHECK_FALSE(is_exactly_symmetric([](float u, float n) {
            const float xi = 2.0f * (n < 0.5f ? n : n - 0.5f);
            const float d = 0x1p-6f * std::exp(-xi * std::log(16.0f));
            const float moved = u + (n < 0.5f ? d : -d);
            return moved - std::floor(moved);
        }));
    }
}

TEST_CASE("a small step stays below one and not below zero, at the borders too") {
    for (const SmallStep& s : {SmallStep(), SmallStep(0x1p-24f, 0.5f)})
        for (float u : {0.0f, 0x1p-24f, 0x1p-10f, 0.5f, 1 - 0x1p-6f, almost_one})
            for (int i = 0; i < 4096; ++i) {
                const float v = s.perturb(u, static_cast<float>(i) / 4096);
                REQUIRE(v >= 0.0f);
                REQUIRE(v < 1.0f);
            }
}

TEST_CASE("the lengths are s2 exp(-xi ln(s2 / s1)) to rounding") {
    const SmallStep s(1.0f / 32, 1.0f / 8);
    for (int i = 0; i < 1000; ++i) {
        const double length = std::exp(-i / 1000.0 * std::log(4.0)) / 8;
        const float number = std::floor(static_cast<float>(i) / 2000 * 0x1p24f) * 0x1p-24f;
        CHECK(std::fabs(way(0.25f, s.perturb(0.25f, number)) - length) < 2 * 0x1p-24);
    }
}

// H0: lengths of either sign have the density 1 / (2 |d| ln(s2 / s1)). Pearson's chi-square over 64
// cells, 1 % over 2 kernels, seed 32; kernels with another density are rejected at 1e-6.
TEST_CASE("small steps follow Kelemen's density", "[statistical]") {
    const double level = mirtest::sidak(0.01, 2);
    const SmallStep usual;
    const auto with = [](const SmallStep& s) {
        return [&](float u, float number) { return s.perturb(u, number); };
    };
    CHECK(kernel_p_value(with(usual), 0x1p-10, 0x1p-6) > level);
    CHECK(kernel_p_value(with(SmallStep(0.1f, 0.3f)), static_cast<double>(0.1f),
                         static_cast<double>(0.3f)) > level);

    const auto uniform = [](float u, float number) {
        const float moved = u + (number - 0.5f) * 0x1p-5f;
        return moved - std::floor(moved);
    };
    const auto upwards = [&](float u, float n) { return usual.perturb(u, 0.5f * n); };
    CHECK(kernel_p_value(uniform, 0x1p-10, 0x1p-6) < 1e-6);
    CHECK(kernel_p_value(upwards, 0x1p-10, 0x1p-6) < 1e-6);
    CHECK(kernel_p_value(with(SmallStep(0x1p-9f, 0x1p-6f)), 0x1p-10, 0x1p-6) < 1e-6);
}

TEST_CASE("lengths that fit no circle are refused") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    using Range = std::array<float, 2>;
    for (const Range& r :
         {Range{0.0f, 0.1f}, {0.2f, 0.1f}, {0.1f, 0.6f}, {-0.1f, 0.1f}, {nan, 0.1f}, {0.1f, nan}}) {
        CAPTURE(r[0], r[1]);
        CHECK_THROWS_AS(SmallStep(r[0], r[1]), mir::Error);
    }
}
