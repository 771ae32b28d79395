// SPDX-License-Identifier: MIT
#include "mir/io/tone_curve.hpp"

#include "support/catch.hpp"

#include <limits>

using mir::Image;
using mir::Rgb;
using mir::ToneCurve;
using mir::toned;
using mirtest::Approx;

TEST_CASE("tone curves have their closed forms") {
    CHECK(toned({0.25f, 2.0f, -1.0f}, ToneCurve::none) == Rgb{0.25f, 1.0f, 0.0f});
    CHECK(toned({1.0f, 3.0f, 0.0f}, ToneCurve::reinhard) == Rgb{0.5f, 0.75f, 0.0f});
    // 0.18 (2.51 0.18 + 0.03) / (0.18 (2.43 0.18 + 0.59) + 0.14).
    CHECK(double(toned({0.18f, 0.0f, 0.0f}, ToneCurve::aces).r) == Approx(0.26689).epsilon(1e-4));
    // Middle grey lies 12.473931 - 2.473931 stops above the lowest of 16.5.
    CHECK(double(toned({0.18f, 0.18f, 0.18f}, ToneCurve::agx).g) == Approx(0.2154).epsilon(0.03));
}

TEST_CASE("tone curves rise, stay in 0..1, and keep grey grey") {
    for (const mir::ToneCurveName& t : mir::tone_curve_names) {
        INFO(t.name);
        float last = -1.0f;
        for (float ev = -14.0f; ev < 12.0f; ev += 0.25f) {
            const float x = std::exp2(ev);
            const Rgb c = toned({x, x, x}, t.curve);
            CHECK(c.g >= last);
            CHECK(c.g <= 1.0f);
            CHECK(double(c.r) == Approx(double(c.g)).margin(0.003));
            CHECK(double(c.b) == Approx(double(c.g)).margin(0.003));
            last = c.g;
        }
        CHECK(last > 0.97f);
    }
}

TEST_CASE("what is no colour is black, what is infinite is white") {
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const mir::ToneCurveName& t : mir::tone_curve_names) {
        INFO(t.name);
        const Rgb white = toned({infinity, infinity, infinity}, t.curve);
        CHECK(std::min({white.r, white.g, white.b}) > 0.97f);
        CHECK(luminance(toned({nan, -infinity, 0.0f}, t.curve)) < 1e-4f);
    }
}

TEST_CASE("bright colours fade to white by AgX alone") {
    const Rgb bright{64.0f, 0.0f, 0.0f};
    CHECK(toned(bright, ToneCurve::agx).g > 0.2f);
    CHECK(toned(bright, ToneCurve::aces).g == 0.0f);
}

TEST_CASE("the exposure of a curve maps the mean brightness to middle grey") {
    Image<Rgb> image({50, 40});
    for (std::uint32_t y = 0; y < 40; ++y)
        for (std::uint32_t x = 0; x < 50; ++x) {
            const float v = std::exp2(static_cast<float>(x % 5) - 2.0f);
            image(x, y) = {v, v, v};
        }
    const float plain = mir::tone_exposure(image);
    CHECK(double(plain) == Approx(std::log2(0.18)));
    Image<Rgb> brighter = image;
    for (Rgb& p : brighter.pixels()) p = p * 1024.0f;
    CHECK(double(mir::tone_exposure(brighter)) == Approx(double(plain) - 10.0));
    SECTION("whatever is black behind it") {
        Image<Rgb> small({500, 40});
        for (std::uint32_t y = 0; y < 40; ++y)
            for (std::uint32_t x = 0; x < 50; ++x) small(x, y) = image(x, y);
        CHECK(mir::tone_exposure(small) == plain);
    }
    SECTION("whatever lamps and sparks there are") {
        for (std::uint32_t x = 0; x < 50; ++x) image(x, 7) = {1e6f, 1e6f, 1e6f};
        image(3, 3).r = std::numeric_limits<float>::infinity();
        CHECK(std::fabs(mir::tone_exposure(image) - plain) < 0.2f);
    }
    CHECK(mir::tone_exposure(Image<Rgb>({3, 3})) == 0.0f);
    CHECK(mir::tone_exposure(Image<Rgb>{}) == 0.0f);
}
