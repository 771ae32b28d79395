// SPDX-License-Identifier: MIT
#include "mir/core/rgb.hpp"

#include "support/catch.hpp"

#include <limits>

using mir::Rgb;

static_assert(sizeof(Rgb) == 12);
static_assert(Rgb{1, 2, 3} + Rgb{4, 5, 6} == Rgb{5, 7, 9});
static_assert(Rgb{4, 5, 6} - Rgb{1, 2, 3} == Rgb{3, 3, 3});
static_assert(Rgb{1, 2, 3} * Rgb{4, 5, 6} == Rgb{4, 10, 18});
static_assert(2.0f * Rgb{1, 2, 3} == Rgb{1, 2, 3} * 2.0f);
static_assert(mir::max_channel({1, 3, 2}) == 3 && mir::max_channel({3, 1, 2}) == 3 &&
              mir::max_channel({1, 2, 3}) == 3);
static_assert(mir::is_black({}) && mir::is_black({0.0f, -0.0f, 0.0f}));
static_assert(!mir::is_black({0, 0, 1e-40f}));

TEST_CASE("What is not kept is black, whatever it was") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(mir::kept_if(true, {1, 2, 3}) == Rgb{1, 2, 3});
    CHECK(mir::kept_if(false, {1, nan, -3}) == Rgb{});
    CHECK(mir::sum_if(true, {1, 2, 3}, {4, 5, 6}) == Rgb{5, 7, 9});
    CHECK(mir::sum_if(false, {1, 2, 3}, {4, nan, 6}) == Rgb{1, 2, 3});
}

TEST_CASE("Luminance has the weights of Rec. 709, which add up to one") {
    CHECK(mir::luminance({1, 0, 0}) == 0.2126f);
    CHECK(mir::luminance({0, 1, 0}) == 0.7152f);
    CHECK(mir::luminance({0, 0, 1}) == 0.0722f);
    CHECK(mir::luminance({1, 1, 1}) == mirtest::Approx(1.0f).epsilon(1e-6));
}

TEST_CASE("One channel that is not finite makes a colour not finite") {
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(mir::is_finite(Rgb{1, 2, 3}));
    CHECK_FALSE(mir::is_finite(Rgb{nan, 0, 0}));
    CHECK_FALSE(mir::is_finite(Rgb{0, infinity, 0}));
    CHECK_FALSE(mir::is_finite(Rgb{0, 0, -infinity}));
}
