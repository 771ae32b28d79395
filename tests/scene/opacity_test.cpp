// SPDX-License-Identifier: MIT
#include "mir/scene/opacity.hpp"

#include "mir/core/random.hpp"
#include "mir/scene/world_geometry.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"
#include "support/textured_scene.hpp"

#include <array>
#include <cmath>

using namespace mirtest;
using mir::Vec3;

namespace {

constexpr std::uint64_t seed = 31;

Vec3 point_of(mir::Random& random) {
    const mir::Vec2 xy = random.next_2d();
    return {xy.x, xy.y, random.next()};
}

/// Cells of numbers of two triangles; `step` goes from one segment to the next.
template <class Step>
double p_value_of_pairs(std::uint32_t first, std::uint32_t second, const Step& step) {
    Histogram cells(16, 16);
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const auto [a, b] = step(i);
        cells.add(double{mir::crossing_number(a, b, first)},
                  double{mir::crossing_number(a, b, second)});
    }
    return cells.against([](double, double) { return 1.0; }).p_value;
}

mir::Material blended(float alpha) {
    mir::Material m = mir::lambertian("veil", {1, 1, 1});
    m.is_blended = true;
    m.alpha = alpha;
    return m;
}

mir::Material glass() {
    mir::Material m = mir::lambertian("glass", {0.9f, 0.6f, 0.3f});
    m.specular = 1.0f;
    m.roughness = 0.0f;
    m.transmission = 0.8f;
    return m;
}

}  // namespace

TEST_CASE("a crossing's number depends on the segment and the triangle alone") {
    const Vec3 a(0.25f, -1.5f, 3.0f);
    const Vec3 b(7.0f, 0.0f, -0.125f);
    CHECK(mir::crossing_number(a, b, 5) == mir::crossing_number(b, a, 5));
    CHECK(mir::crossing_number(a, b, 5) == mir::crossing_number(a, {7.0f, -0.0f, -0.125f}, 5));
    CHECK(mir::crossing_number(a, b, 5) != mir::crossing_number(a, b, 6));
    CHECK(mir::crossing_number(a, a, 5) != mir::crossing_number(b, b, 5));
    // Pinned: pictures depend on it.
    CHECK(mir::crossing_number(a, b, 5) == 0x1.75738p-1f);
}

TEST_CASE("numbers of crossings are uniform and independent", "[statistical]") {
    // H0: the numbers of two triangles are uniform in the unit square; Pearson's test on 16 x 16
    // cells, family level 1e-4 over the tests, seed 31. Neighbours of a segment are those that a
    // picture asks about: luxels in a row, one VPL.
    mir::Random random(seed, mir::Stream::test, 0);
    const Vec3 eye(0.3f, 2.0f, 0.7f);
    const auto scattered = [&](std::uint32_t) {
        return std::array{point_of(random), point_of(random)};
    };
    const auto in_a_row = [&](std::uint32_t i) {
        return std::array{eye, Vec3(1.0f + 0x1p-23f * static_cast<float>(i), 0.0f, 1.0f)};
    };
    const auto on_a_grid = [&](std::uint32_t i) {
        const auto x = static_cast<float>(i % 317);
        const auto y = static_cast<float>(i / 317);
        return std::array{Vec3(x, 0.0f, y), Vec3(y, 1.0f, x)};
    };
    const std::array p{p_value_of_pairs(0, 1, scattered),   p_value_of_pairs(0, 1, in_a_row),
                       p_value_of_pairs(0, 1, on_a_grid),   p_value_of_pairs(7, 4096, scattered),
                       p_value_of_pairs(7, 4096, in_a_row), p_value_of_pairs(7, 4096, on_a_grid)};
    for (const double value : p) CHECK(value > sidak(1e-4, p.size()));
    // Neighbouring segments, one triangle.
    Histogram neighbours(16, 16);
    for (std::uint32_t i = 0; i < 200000; i += 2)
        neighbours.add(double{mir::crossing_number(eye, in_a_row(i)[1], 3)},
                       double{mir::crossing_number(eye, in_a_row(i + 1)[1], 3)});
    CHECK(neighbours.against([](double, double) { return 1.0; }).p_value > 1e-5);
    // The test notices numbers that are the same for both.
    CHECK(p_value_of_pairs(2, 2, scattered) < 1e-6);
}

TEST_CASE("the mean of the bits is the transmittance", "[statistical]") {
    // H0: per cell of cosines and alphas the share of open segments is the luminance of
    // straight_transmittance(). z of the sum of (bit - T) over its variance, level 1e-5, seed 31.
    for (const bool is_textured : {false, true})
        for (mir::Material m : {blended(0.3f), glass()}) {
            if (is_textured) m.textures.base_color = texture_of(0);
            mir::Scene scene = textured_triangle(m);
            scene.images[0].texels = {texel(255, 90, 10, 0), texel(200, 9, 99, 102),
                                      texel(9, 255, 9, 204), texel(250, 250, 250, 255)};
            const mir::WorldGeometry geometry(scene);
            const auto opacity = geometry.opacity();
            REQUIRE(opacity.exists());
            CHECK_FALSE(opacity.stops_all(0));
            CHECK(opacity.masks().is_solid(0, {0.1f, 0.1f}));
            mir::Random random(seed, mir::Stream::test, 1);
            double sum = 0.0;
            double variance = 0.0;
            for (int i = 0; i < 40000; ++i) {
                // At all angles, most of them wide.
                const Vec3 flat(1.0f, 1.0f, 0.2f);
                const Vec3 a = flat * point_of(random);
                const Vec3 b = -flat * point_of(random);
                const auto stops = opacity.between(a, b);
                const float s = a.z / (a.z - b.z);
                const Vec3 at = a + s * (b - a);
                const mir::Vec2 barycentrics(0.5f * std::fabs(at.x), 0.5f * std::fabs(at.y));
                const Vec3 d = glm::normalize(b - a);
                CHECK(stops.cosine_to(0) == Approx(std::fabs(d.z)).epsilon(1e-4));
                const double t = double{opacity.see_through[0].transmittance(
                    opacity.textures, opacity.geometry.attributes(0, barycentrics),
                    stops.cosine_to(0))};
                sum += (stops.is_solid(0, barycentrics) ? 0.0 : 1.0) - t;
                variance += t * (1.0 - t);
            }
            INFO(m.name << " " << is_textured << ": " << sum << " of " << variance);
            CHECK(std::fabs(sum) < 4.42 * std::sqrt(variance));
            CHECK(variance > 1000.0);
        }
}

TEST_CASE("textures and alpha change how much goes through") {
    const auto open = [](const mir::Material& m, mir::Vec2 barycentrics) {
        mir::Scene scene = textured_triangle(m);
        scene.images[0].texels.assign(4, texel(0, 255, 0, 51));
        const mir::WorldGeometry geometry(scene);
        const auto opacity = geometry.opacity();
        return opacity.see_through[0].transmittance(
            opacity.textures, geometry.view().attributes(0, barycentrics), 1.0f);
    };
    const mir::Vec2 middle(0.2f, 0.2f);
    mir::Material veil = blended(0.5f);
    CHECK(open(veil, middle) == Approx(0.5));
    veil.textures.base_color = texture_of(0);
    CHECK(open(veil, middle) == Approx(0.9));
    mir::Material pane = glass();
    const double below = 0.8 * 0.96;
    CHECK(open(pane, middle) == Approx(below * (0.2126 * 0.9 + 0.7152 * 0.6 + 0.0722 * 0.3)));
    pane.textures.base_color = texture_of(0);
    CHECK(open(pane, middle) == Approx(below * 0.7152 * 0.6));
    pane.textures.metallic_roughness = texture_of(0);
    CHECK(open(pane, middle) > 0.0f);
    pane.roughness = 1.0f;  // nothing goes straight through
    CHECK(open(pane, middle) == 0.0f);
}

TEST_CASE("a transmission that is no share is refused") {
    mir::Material m = glass();
    m.transmission = 1.5f;
    const mir::Scene scene = textured_triangle(m);
    CHECK_THROWS_WITH(mir::WorldGeometry(scene),
                      Catch::Contains("'glass': its transmission is 1.5"));
}
