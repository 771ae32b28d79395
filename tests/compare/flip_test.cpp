// SPDX-License-Identifier: MIT
#include "mir/compare/flip.hpp"

#include "compare/flip_table.hpp"
#include "mir/compare/metrics.hpp"
#include "support/catch.hpp"

#include <cstddef>
#include <cstdint>

// The authors publish one value for LDR-FLIP, a mean of 0.159691 for the images reference.png and
// test.png of their repository. Those files are not part of any package and are not repeated here.
// Instead the table below holds what the authors' own program, flip-evaluator 1.7, computes for the
// procedural images of flip_images.hpp (linear input, no colour map, mean of the map in doubles).
namespace {

using mir::Image;
using mir::Rgb;
using namespace mirtest;

using Pair = FlipRow<float>;  // with pixels per degree

Picture plain(double r, double g, double b) {
    return Picture(flip_size,
                   Rgb{static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)});
}

Picture checker(std::uint32_t shift) {
    return painted(
        [&](auto x, auto y, auto) { return ((x + shift) / 8 + y / 8) % 2 == 0 ? 0.8 : 0.1; });
}

std::vector<Pair> make_table() {
    const float usual = mir::default_pixels_per_degree;
    const Picture ramps = painted(ramp);
    const Picture dim = painted([](auto... at) { return 0.8 * ramp(at...); });
    const Picture noisy = painted(
        [](auto... at) { return std::clamp(ramp(at...) + 0.3 * (noise(at...) - 0.5), 0.0, 1.0); });
    const Picture lines = painted([](auto x, auto, auto) { return x % 12 == 5 ? 0.05 : 0.6; });
    return {
        {"colours", plain(0.2, 0.4, 0.6), plain(0.6, 0.4, 0.2), usual,  //
         0.7646176, 0.764618, 0.764618, 0.764618},
        {"black and white", plain(0, 0, 0), plain(1, 1, 1), usual,  //
         0.9673883, 0.967388, 0.967388, 0.967388},
        {"green and blue", plain(0, 1, 0), plain(0, 0, 1), usual, 1.0, 1.0, 1.0, 1.0},
        {"dim", dim, ramps, usual, 0.3389873, 0.317443, 0.131255, 0.299332},
        {"checker", checker(1), checker(0), usual, 0.2335516, 0.122031, 0.0, 0.854913},
        {"checker 30", checker(1), checker(0), 30.0f, 0.1937043, 0.0, 0.0, 0.945576},
        {"checker 120", checker(1), checker(0), 120.0f, 0.1886968, 0.204508, 0.004360, 0.680251},
        {"noise", noisy, ramps, usual, 0.1398015, 0.098532, 0.537947, 0.267332},
        {"noise 30", noisy, ramps, 30.0f, 0.2634908, 0.300868, 0.674246, 0.325742},
        {"noise 120", noisy, ramps, 120.0f, 0.1034554, 0.093496, 0.486391, 0.288883},
        {"lines", plain(0.6, 0.6, 0.6), lines, usual, 0.1442359, 0.001398, 0.000888, 0.0},
    };
}

const std::vector<Pair>& tabulated() {
    static const std::vector<Pair> table = make_table();
    return table;
}

template <class Flip>
double deviation(const Flip& flip) {
    return deviation_from_table(tabulated(), flip);
}

const auto right = [](const Picture& a, const Picture& b, float ppd) {
    return mir::ldr_flip(a, b, ppd);
};

template <class F>
Picture each(const Picture& image, const F& f) {
    Picture out = image;
    for (Rgb& pixel : out.pixels()) pixel = f(pixel);
    return out;
}

Rgb srgb_codes(Rgb c) {
    const auto code = [](float v) {
        return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
    };
    return {code(c.r), code(c.g), code(c.b)};
}

struct BackwardsExecutor {
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        while (n-- > 0) body(n);
    }
    [[nodiscard]] std::size_t concurrency() const { return 1; }
};

Picture transposed(const Picture& image) {
    Picture out({image.height(), image.width()});
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) out(y, x) = image(x, y);
    return out;
}

}  // namespace

TEST_CASE("LDR-FLIP agrees with its authors' program") { CHECK(deviation(right) < flip_tolerance); }

TEST_CASE("a FLIP that takes sRGB codes for light is rejected") {
    const auto wrong = [](const Picture& a, const Picture& b, float ppd) {
        return mir::ldr_flip(each(a, srgb_codes), each(b, srgb_codes), ppd);
    };
    REQUIRE(deviation(wrong) > 10.0 * flip_tolerance);
}

TEST_CASE("a FLIP that mistakes red for blue is rejected") {
    const auto swapped = [](Rgb c) { return Rgb{c.b, c.g, c.r}; };
    const auto wrong = [&](const Picture& a, const Picture& b, float ppd) {
        return mir::ldr_flip(each(a, swapped), each(b, swapped), ppd);
    };
    REQUIRE(deviation(wrong) > 10.0 * flip_tolerance);
}

TEST_CASE("a FLIP that ignores the distance of the observer is rejected") {
    const auto wrong = [](const Picture& a, const Picture& b, float) {
        return mir::ldr_flip(a, b);
    };
    REQUIRE(deviation(wrong) > 10.0 * flip_tolerance);
}

TEST_CASE("a FLIP without feature detectors is rejected") {
    const auto wrong = [](const Picture& a, const Picture& b, float ppd) {
        mir::InlineExecutor here;
        const mir::detail::FlipFilters filters(ppd);
        mir::detail::Percept p = mir::detail::percept_of(a, filters, here);
        const mir::detail::Percept q = mir::detail::percept_of(b, filters, here);
        p.edge = q.edge;
        p.point = q.point;
        return mir::detail::flip_errors(p, q, here);
    };
    REQUIRE(deviation(wrong) > 10.0 * flip_tolerance);
}

TEST_CASE("a FLIP that leaves out one of the blue-yellow Gaussians is rejected") {
    const auto wrong = [](const Picture& a, const Picture& b, float ppd) {
        mir::InlineExecutor here;
        mir::detail::FlipFilters filters(ppd);
        filters.blue_yellow[0] = filters.blue_yellow[1];
        return mir::detail::flip_errors(mir::detail::percept_of(a, filters, here),
                                        mir::detail::percept_of(b, filters, here), here);
    };
    REQUIRE(deviation(wrong) > 10.0 * flip_tolerance);
}

TEST_CASE("LDR-FLIP of equal images is zero everywhere") {
    const Picture image = painted(noise);
    const Image<float> map = mir::ldr_flip(image, image);
    CHECK(std::all_of(map.pixels().begin(), map.pixels().end(), [](float e) { return e == 0; }));
}

TEST_CASE("LDR-FLIP is symmetric and stays within 0 and 1") {
    const Picture a = painted(noise);
    const Picture b = painted(ramp);
    const Image<float> ab = mir::ldr_flip(a, b);
    const Image<float> ba = mir::ldr_flip(b, a);
    CHECK(std::equal(ab.pixels().begin(), ab.pixels().end(), ba.pixels().begin()));
    CHECK(std::all_of(ab.pixels().begin(), ab.pixels().end(),
                      [](float e) { return e >= 0.0f && e <= 1.0f; }));
}

TEST_CASE("LDR-FLIP does not depend on the order of its loops") {
    const Picture a = painted(noise);
    const Picture b = painted(ramp);
    const Image<float> forwards = mir::ldr_flip(a, b);
    const Image<float> backwards =
        mir::ldr_flip(a, b, mir::default_pixels_per_degree, BackwardsExecutor());
    CHECK(
        std::equal(forwards.pixels().begin(), forwards.pixels().end(), backwards.pixels().begin()));
}

TEST_CASE("LDR-FLIP treats rows and columns alike") {
    const Picture a = painted(noise);
    const Picture b = painted(ramp);
    const Image<float> map = mir::ldr_flip(a, b);
    const Image<float> turned = mir::ldr_flip(transposed(a), transposed(b));
    for (std::uint32_t y = 0; y < a.height(); ++y)
        for (std::uint32_t x = 0; x < a.width(); ++x)
            REQUIRE(map(x, y) == Approx(turned(y, x)).margin(1e-4));
}

TEST_CASE("LDR-FLIP clamps what no display can show") {
    const Image<float> map = mir::ldr_flip(plain(-2, 7, 0.5), plain(0, 1, 0.5));
    CHECK(mir::mean_of(map) == 0.0);
}

TEST_CASE("the colour spaces of FLIP have white where it belongs and lead back") {
    const mir::Vec3 white = mir::detail::hunt_lab_of({1, 1, 1});
    CHECK(white.x == Approx(100.0f).epsilon(1e-5));
    CHECK(std::fabs(white.y) < 1e-3f);
    CHECK(std::fabs(white.z) < 1e-3f);
    const Rgb colour{0.1f, 0.7f, 0.4f};
    const Rgb back = mir::detail::rgb_of_ycxcz(mir::detail::ycxcz_of(colour));
    CHECK(back.r == Approx(colour.r).epsilon(1e-5));
    CHECK(back.g == Approx(colour.g).epsilon(1e-5));
    CHECK(back.b == Approx(colour.b).epsilon(1e-5));
    // CIELAB of Rec. 709 green, as colour science tables have it: 87.73, -86.18, 83.18.
    const mir::Vec3 green = mir::detail::hunt_lab_of({0, 1, 0});
    CHECK(green.x == Approx(87.73).epsilon(1e-3));
    CHECK(green.y == Approx(-86.18 * 0.8773).epsilon(1e-3));
    CHECK(green.z == Approx(83.18 * 0.8773).epsilon(1e-3));
}

TEST_CASE("LDR-FLIP works on images smaller than its filters") {
    const Picture a({1, 1}, Rgb{0.2f, 0.4f, 0.6f});
    const Picture b({1, 1}, Rgb{0.6f, 0.4f, 0.2f});
    CHECK(mir::ldr_flip(a, b)(0, 0) == Approx(0.764618).margin(flip_tolerance));
}

TEST_CASE("LDR-FLIP refuses what it cannot compare") {
    const Picture a({4, 4});
    CHECK_THROWS_AS(mir::ldr_flip(a, Picture({4, 5})), mir::Error);
    CHECK_THROWS_AS(mir::ldr_flip(Picture{}, Picture{}), mir::Error);
    for (const float ppd : {0.0f, 0.5f, 1001.0f, std::nanf("")})
        CHECK_THROWS_AS(mir::ldr_flip(a, a, ppd), mir::Error);
}
