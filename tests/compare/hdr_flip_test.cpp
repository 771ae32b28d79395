// SPDX-License-Identifier: MIT
#include "mir/compare/hdr_flip.hpp"

#include "compare/flip_table.hpp"
#include "mir/compare/metrics.hpp"
#include "support/catch.hpp"

// The authors publish one value for HDR-FLIP, a mean of 0.283478 for their reference.exr and
// test.exr, which are not part of any package. As in flip_test.cpp the table holds what their
// program, flip-evaluator 1.7, computes for procedural images instead.
namespace {

using mir::Image;
using mir::Rgb;
using namespace mirtest;

using Pair = FlipRow<mir::FlipExposures>;

std::vector<Pair> make_table() {
    const mir::FlipExposures wide{-4.239546775817871f, 6.340281963348389f, 11};
    const mir::FlipExposures dark{0.08329720050096512f, 24.083297729492188f, 24};
    const Picture lit = painted(room);
    const Picture noisy =
        painted([](auto... at) { return room(at...) * (0.7 + 0.6 * noise(at...)); });
    const Picture sparks = painted([](auto x, auto y, auto c) {
        const std::uint32_t hash = (x * 73 + y * 151 + c * 199 + x * y * 37) % 256;
        return room(x, y, c) + (hash % 251 == 7 ? 3.0 : 0.0);
    });
    const Picture lamp = painted([](auto x, auto y, auto) { return in_spot(x, y) ? 2.0 : 0.0; });
    const Picture haze = painted(
        [](auto x, auto y, auto c) { return in_spot(x, y) ? 2.0 : 0.001 * noise(x, y, c); });
    return {
        {"noise", noisy, lit, wide, 0.1054771, 0.049392, 0.042940, 0.261953},
        {"sparks", sparks, lit, wide, 0.0843881, 0.003149, 0.003101, 0.019331},
        {"haze", haze, lamp, dark, 0.9564827, 0.025652, 0.981585, 0.982540},
    };
}

const std::vector<Pair>& tabulated() {
    static const std::vector<Pair> table = make_table();
    return table;
}

template <class Flip>
double deviation(const Flip& flip) {
    return deviation_from_table(
        tabulated(), [&](const Picture& a, const Picture& b,
                         const mir::FlipExposures& /*found by itself*/) { return flip(a, b); });
}

}  // namespace

TEST_CASE("HDR-FLIP agrees with its authors' program") {
    CHECK(deviation([](const Picture& a, const Picture& b) { return mir::hdr_flip(a, b); }) <
          flip_tolerance);
}

TEST_CASE("an HDR-FLIP that exposes for the image instead of the reference is rejected") {
    REQUIRE(deviation([](const Picture& a, const Picture& b) { return mir::hdr_flip(b, a); }) >
            10.0 * flip_tolerance);
}

TEST_CASE("an HDR-FLIP that looks at one exposure is rejected") {
    REQUIRE(deviation([](const Picture& a, const Picture& b) {
                const float exposure = mir::flip_exposures(b).start;
                return mir::ldr_flip(mir::detail::tone_mapped(a, exposure),
                                     mir::detail::tone_mapped(b, exposure));
            }) > 10.0 * flip_tolerance);
}

TEST_CASE("the exposures of HDR-FLIP are those of its authors' program") {
    for (const Pair& p : tabulated()) {
        INFO(p.name);
        const mir::FlipExposures e = mir::flip_exposures(p.reference);
        CHECK(e.start == Approx(p.setting.start).epsilon(1e-5));
        CHECK(e.stop == Approx(p.setting.stop).epsilon(1e-5));
        CHECK(e.count == p.setting.count);
        CHECK(e.at(0) == e.start);
        CHECK(e.at(e.count - 1) == Approx(e.stop));
    }
}

TEST_CASE("the tone curve of HDR-FLIP and its inverse fit, and light without bound is white") {
    const auto x = static_cast<float>(mir::detail::AcesCurve::inverse(0.85));
    CHECK(mir::detail::AcesCurve::value(x) == Approx(0.85f));
    CHECK(mir::detail::AcesCurve::value(0.0f) == 0.0f);
    CHECK(mir::detail::AcesCurve::value(-1.0f) == 0.0f);
    CHECK(mir::detail::AcesCurve::value(3e38f) == 1.0f);
}

TEST_CASE("HDR-FLIP does not depend on the unit of light") {
    const Picture a =
        painted([](auto... at) { return 64.0 * room(at...) * (0.7 + 0.6 * noise(at...)); });
    const Picture b = painted([](auto... at) { return 64.0 * room(at...); });
    CHECK(mir::mean_of(mir::hdr_flip(a, b)) == Approx(tabulated()[0].mean).epsilon(1e-3));
}

TEST_CASE("HDR-FLIP counts negative light as none") {
    const Picture lit = painted(room);
    const Picture below = painted([](auto... at) { return room(at...) - 0.02; });
    const Picture clipped = painted([](auto... at) { return std::max(room(at...) - 0.02, 0.0); });
    CHECK(mir::mean_of(mir::hdr_flip(below, lit)) == mir::mean_of(mir::hdr_flip(clipped, lit)));
}

TEST_CASE("HDR-FLIP of equal images is zero, also where they are black or blinding") {
    for (const float light : {0.0f, 1.0f, 3e38f}) {
        const Picture image({5, 4}, Rgb{light, light, light});
        CHECK(mir::mean_of(mir::hdr_flip(image, image)) == 0.0);
    }
}

TEST_CASE("HDR-FLIP is nowhere below LDR-FLIP at one of its exposures") {
    const Pair& p = tabulated()[1];
    const float exposure = mir::flip_exposures(p.reference).at(4);
    const Image<float> hdr = mir::hdr_flip(p.image, p.reference);
    const Image<float> ldr = mir::ldr_flip(mir::detail::tone_mapped(p.image, exposure),
                                           mir::detail::tone_mapped(p.reference, exposure));
    int below = 0;
    for (std::size_t i = 0; i < hdr.pixels().size(); ++i)
        below += hdr.pixels()[i] < ldr.pixels()[i] ? 1 : 0;
    CHECK(below == 0);
}
