// SPDX-License-Identifier: MIT
#include "mir/core/unit_circle.hpp"

#include "mir/core/circle_turns.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

namespace {

/// Largest absolute error of cosine and sine over `steps` + 1 places from `first` to `last` turns.
double largest_error(double first, double last, int steps) {
    constexpr double full_turn = 6.283185307179586476925;
    double largest = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const auto turns = static_cast<float>(first + (last - first) * i / steps);
        const mir::Vec2 p = mir::unit_circle(turns);
        // Whole turns are taken off exactly before the product with 2 pi.
        const double angle = full_turn * std::remainder(static_cast<double>(turns), 1.0);
        largest = std::max({largest, std::fabs(static_cast<double>(p.x) - std::cos(angle)),
                            std::fabs(static_cast<double>(p.y) - std::sin(angle))});
    }
    return largest;
}

}  // namespace

TEST_CASE("cosine and sine of turns keep to their error bound") {
    CHECK(largest_error(0.0, 1.0, 1 << 22) < 1.5e-7);
    CHECK(largest_error(-0.125, 0.375, 1 << 20) < 1.5e-7);
    CHECK(largest_error(-3.0, 3.0, 1 << 20) < 1.5e-7);
    CHECK(largest_error(-1e6, 1e6, 1 << 20) < 1.5e-7);
}

TEST_CASE("cosine and sine are exact at multiples of a quarter turn") {
    const mir::Vec2 quarters[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int i = -40; i <= 40; ++i)
        CHECK(mir::unit_circle(0.25f * static_cast<float>(i)) == quarters[(i + 40) % 4]);
}

TEST_CASE("cosine and sine of tiny turns keep their relative precision") {
    for (float turns : {1e-3f, 1e-10f, 1e-30f, -1e-20f}) {
        const double angle = 6.283185307179586476925 * static_cast<double>(turns);
        CHECK(mir::unit_circle(turns).y == mirtest::Approx(std::sin(angle)).epsilon(2e-7));
    }
}

TEST_CASE("turns of a direction keep to their error bound, at any length") {
    double largest = 0.0;
    for (int i = 0; i < 1 << 20; ++i) {
        const double angle = 6.283185307179586476925 * (i / double{1 << 20} - 0.5);
        const double length = std::exp2(i % 41 - 20);
        const mir::Vec2 d(length * std::cos(angle), length * std::sin(angle));
        const double exact = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) /
                             6.283185307179586476925;
        const auto turns = static_cast<double>(mir::circle_turns(d));
        largest = std::max(largest, std::fabs(turns - exact));
    }
    CHECK(largest < 6e-8);
}

TEST_CASE("turns are exact at multiples of an eighth and keep the precision of tiny ones") {
    const mir::Vec2 eighths[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
    for (int i = 0; i < 5; ++i) {
        CHECK(mir::circle_turns(3.0f * eighths[i]) == 0.125f * static_cast<float>(i));
        CHECK(mir::circle_turns({eighths[i].x, -eighths[i].y}) ==
              (i < 4 ? -0.125f : 0.125f) * static_cast<float>(i));
    }
    CHECK(mir::circle_turns({0, 0}) == 0.0f);
    CHECK(mir::circle_turns({1, 1e-20f}) == mirtest::Approx(1.59154943e-21).epsilon(2e-7));
}
