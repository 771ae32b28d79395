// SPDX-License-Identifier: MIT
#include "mir/shading/scene_light.hpp"

#include "mir/core/warp.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/statistics.hpp"

namespace {

using mir::Hit;
using mir::Lambert;
using mir::Rgb;
using mir::Scene;
using mir::Vec3;
using mirtest::Approx;
using mirtest::FreeSight;
using mirtest::Moments;

// Every test of a mean in this file belongs to one family of level 1 %.
const double level = mirtest::sidak(0.01, 22);

/// A scene with what light needs of it. Radiance of a receiver with f = 1 is its irradiance.
struct Lit {
    Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};

    explicit Lit(Scene s) : scene(std::move(s)) {}

    float from_emitters(Vec3 at, Vec3 normal, std::uint32_t samples, mir::Random& random,
                        mir::SharedSamples shared = {}) const {
        const mir::EmitterLight<Lambert, FreeSight> light{lights, {}, samples};
        return light({at, normal}, receiver(normal), shared, random).r;
    }
    float from_listed(Vec3 at, Vec3 normal) const {
        const mir::ListedLight<Lambert, FreeSight> light{lights, {}};
        const auto unasked = [](std::uint32_t) -> mir::Vec2 { throw 0; };
        return light({at, normal}, receiver(normal), unasked).r;
    }
    static mir::Surface<Lambert::Params> receiver(Vec3 normal) {
        return {normal, normal, {}, {{mir::pi, mir::pi, mir::pi}}};
    }
};

const Vec3 up(0, 1, 0);

/// Estimates of the irradiance at a point from independent seeds.
Moments irradiance(const Lit& lit, Vec3 at, Vec3 normal, std::uint64_t seed,
                   std::uint32_t samples = 16, mir::SharedSamples shared = {}) {
    Moments m;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        mir::Random random(seed, mir::Stream::test, i);
        m.add(static_cast<double>(lit.from_emitters(at, normal, samples, random, shared)));
    }
    return m;
}

/// Estimates of the form factor of a receiver in the plane y = 0, a unit square over x in
/// [-1/2, 1/2] whose side of smallest z is `nearest`. Points crowd there: in a corner the light's
/// second moment grows as 1 / z, and uniform points would have no finite variance.
Moments form_factor(const Lit& lit, float nearest, std::uint64_t seed) {
    Moments m;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
        mir::Random random(seed, mir::Stream::test, i);
        const mir::Vec2 u = random.next_2d();
        const Vec3 at(u.x - 0.5f, 0, nearest + u.y * u.y);
        const float weight = 2 * u.y / mir::pi;
        mir::Random lamps(seed, mir::Stream::direct_light, i);
        m.add(static_cast<double>(weight * lit.from_emitters(at, up, 1, lamps)));
    }
    return m;
}

/// Square lamp of radiance 1 and 2 m width, 1 m above the origin, facing down.
Scene square_lamp(bool both_sides = false) {
    Scene s;
    mir::Material m = mir::emitter("lamp", {}, {1, 1, 1});
    m.emits_from_both_sides = both_sides;
    const std::uint32_t lamp = s.add(m);
    s.place(mir::builtin::quad("lamp", lamp, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}));
    return s;
}

}  // namespace

// H0: the mean irradiance is the closed form, for 1 and for 16 samples. Student's t over 4000
// seeds, family level 1 %; twice the level of rounding, 2e-6, is allowed. A value 1 % off is
// rejected.
TEST_CASE("a disc lights the point below its centre with pi L R^2 / (R^2 + h^2)", "[statistical]") {
    const auto [radius, height, samples] =
        GENERATE(std::tuple(1.0f, 1.0f, 16u), std::tuple(0.5f, 2.0f, 1u));
    const Lit lit(mir::builtin::disc_above_plane(radius, height));
    const Moments m = irradiance(lit, {0, 0, 0}, up, 121, samples);
    const auto r2 = static_cast<double>(radius * radius);
    const double expected = mirtest::pi * r2 / (r2 + static_cast<double>(height * height));
    CHECK(mirtest::mean_p_value(m, expected, 2e-6) > level);
    CHECK(mirtest::mean_p_value(m, 1.01 * expected, 2e-6) < level);
}

TEST_CASE("a square lights the point below its centre as Lambert's formula says", "[statistical]") {
    const Moments m = irradiance(Lit(square_lamp()), {0, 0, 0}, up, 122);
    CHECK(mirtest::mean_p_value(m, 1.740839503, 2e-6) > level);
    CHECK(mirtest::mean_p_value(m, 1.01 * 1.740839503, 2e-6) < level);
}

// H0: the mean irradiance below the middle of an edge is Lambert's, for each of four luxels that
// share samples. The two triangles of the lamp light it unequally.
TEST_CASE("each luxel of a pixel gets the light of the whole lamp", "[statistical]") {
    const Lit lit(square_lamp());
    for (std::uint32_t share = 0; share < 4; ++share) {
        const Moments m = irradiance(lit, {1, 0, 0}, up, 130, 1, {4, share});
        CAPTURE(share, m.mean(), m.standard_error());
        CHECK(mirtest::mean_p_value(m, 1.051648) > level);
    }
}

TEST_CASE("an emitter of both sides lights both sides, another only its front", "[statistical]") {
    const Lit both(square_lamp(true));
    CHECK(mirtest::mean_p_value(irradiance(both, {0, 0, 0}, up, 123), 1.740839503, 2e-6) > level);
    CHECK(mirtest::mean_p_value(irradiance(both, {0, 2, 0}, -up, 124), 1.740839503, 2e-6) > level);
    CHECK(irradiance(Lit(square_lamp()), {0, 2, 0}, -up, 125).mean() == 0.0);
}

// H0: the mean over receiver and emitter is the form factor. 40 000 pairs, seeds 126 and 127.
TEST_CASE("parallel unit squares exchange 0.199824896", "[statistical]") {
    const Moments m = form_factor(Lit(mir::builtin::parallel_squares()), -0.5f, 126);
    CHECK(mirtest::mean_p_value(m, 0.199824896) > level);
    CHECK(mirtest::mean_p_value(m, 1.03 * 0.199824896) < level);
}

TEST_CASE("perpendicular unit squares with a common edge exchange 0.200043776", "[statistical]") {
    const Moments m = form_factor(Lit(mir::builtin::perpendicular_squares()), 0.0f, 127);
    CHECK(mirtest::mean_p_value(m, 0.200043776) > level);
    CHECK(mirtest::mean_p_value(m, 1.05 * 0.200043776) < level);
}

TEST_CASE("many samples of one luxel vary less than independent ones") {
    const Lit lit(square_lamp());
    const Vec3 at(0.3f, 0, 0.2f);
    CHECK(irradiance(lit, at, up, 128, 16).variance() <
          0.5 * irradiance(lit, at, up, 129, 1).variance() / 16);
}

TEST_CASE("late points of a Kronecker sequence are as exact as early ones") {
    for (const std::uint32_t i : {1u, 1000u, 65'535u, 4'000'000u}) {
        const mir::Vec2 p = mir::kronecker_point({0.25f, 0.5f}, i);
        const auto distance = [](double a, double b) {
            return std::fabs(std::remainder(a - b, 1.0));
        };
        CHECK(distance(p.x, 0.25 + i * 0.7548776662466927) < 2e-3 / 4e6 * i + 2e-7);
        CHECK(distance(p.y, 0.50 + i * 0.5698402909980532) < 2e-3 / 4e6 * i + 2e-7);
    }
}

TEST_CASE("points of a Kronecker sequence wrap around as fractions do") {
    const float last = 1.0f - 0x1p-24f;
    for (const float x : {0.0f, 0x1p-24f, 0.5f, last, 1.0f, 1.0f + 0x1p-23f, 1.5f, last + last}) {
        INFO(x);
        CHECK(mir::wrapped(x) == glm::fract(x));
    }
}

TEST_CASE("light from below the surface or without samples or lamps is black") {
    const Lit lit(square_lamp());
    mir::Random random(1, mir::Stream::test, 0);
    CHECK(lit.from_emitters({0, 0, 0}, -up, 16, random) == 0.0f);
    CHECK(lit.from_emitters({0, 0, 0}, up, 0, random) == 0.0f);
    const Lit dark(mir::Scene{});
    CHECK(dark.from_emitters({0, 0, 0}, up, 16, random) == 0.0f);
    CHECK(dark.from_listed({0, 0, 0}, up) == 0.0f);
}

TEST_CASE("a point light's irradiance is I cos / d^2") {
    Scene s;
    s.point_lights.push_back({"bulb", {3, 4, 0}, {10, 10, 10}});
    const Lit lit(s);
    CHECK(lit.from_listed({0, 0, 0}, up) == Approx(10 * 0.8 / 25));
    CHECK(lit.from_listed({0, 0, 0}, -up) == 0.0f);
    CHECK(lit.from_listed({3, 2, 0}, up) == Approx(10.0 / 4));
}

TEST_CASE("a spot light's falloff is glTF's: full inside, none outside, squared ramp between") {
    mir::SpotLight spot;
    spot.position = {0, 2, 0};
    spot.direction = {0, -1, 0};
    spot.intensity = {8, 8, 8};
    spot.cos_inner = 0.9f;
    spot.cos_outer = 0.5f;
    Scene s;
    s.spot_lights.push_back(spot);
    const Lit lit(s);
    CHECK(lit.from_listed({0, 0, 0}, up) == Approx(8.0 / 4));
    for (double cosine : {0.95, 0.8, 0.7, 0.6, 0.4}) {
        const double tangent = std::sqrt(1 / (cosine * cosine) - 1);
        const Vec3 at(static_cast<float>(2 * tangent), 0, 0);
        const double ramp = std::clamp((cosine - 0.5) / 0.4, 0.0, 1.0);
        const double d2 = 4 / (cosine * cosine);
        CHECK(lit.from_listed(at, up) == Approx(8 * ramp * ramp * cosine / d2).epsilon(1e-4));
    }
}

TEST_CASE("a spot with equal angles has a hard edge") {
    mir::SpotLight spot;
    spot.cos_inner = spot.cos_outer = 0.8f;
    const mir::SpotSource source = source_of(spot, {});
    CHECK(source.share(spot.direction, mirtest::direction(-0.79, 0)) == 0.0f);
    CHECK(source.share(spot.direction, mirtest::direction(-0.81, 0)) == 1.0f);
}

TEST_CASE("a directional light's irradiance is E cos, at any distance") {
    Scene s = square_lamp();
    s.directional_lights.push_back({"sun", glm::normalize(Vec3(0, -3, 4)), {5, 5, 5}});
    const Lit lit(s);
    CHECK(lit.from_listed({0, 0, 0}, up) == Approx(5 * 0.6));
    CHECK(lit.from_listed({1e4f, -1e4f, 0}, up) == Approx(5 * 0.6));
    CHECK(lit.from_listed({0, 0, 0}, -up) == 0.0f);
}

TEST_CASE("delta lights of all kinds add up") {
    Scene s = square_lamp();
    s.directional_lights.push_back({"sun", {0, -1, 0}, {5, 5, 5}});
    s.point_lights.push_back({"bulb", {0, 2, 0}, {4, 4, 4}});
    s.point_lights.push_back({"bulb", {0, 1, 0}, {2, 2, 2}});
    CHECK(Lit(s).from_listed({0, 0, 0}, up) == Approx(5.0 + 1.0 + 2.0));
}

TEST_CASE("a point or spot light on the luxel, or so near that light overflows, brings nothing") {
    const Vec3 lamp = GENERATE(Vec3(0, 0, 0), Vec3(0, 1e-30f, 0), Vec3(0, 1e-19f, 0));
    mir::SpotLight spot;
    spot.position = lamp;
    spot.direction = {0, -1, 0};
    spot.intensity = {1e3f, 1e3f, 1e3f};
    Scene scene;
    scene.directional_lights.push_back({"sun", {0, -1, 0}, {5, 5, 5}});
    scene.spot_lights.push_back(spot);
    scene.point_lights.push_back({"bulb", lamp, {1e3f, 1e3f, 1e3f}});
    CHECK(Lit(scene).from_listed({0, 0, 0}, up) == Approx(5.0));
}

TEST_CASE("light that the shading or the geometric normal turns away from is not reflected") {
    const Vec3 tilted = glm::normalize(Vec3(1, 1, 0));
    auto s = Lit::receiver(tilted);
    const Hit hit{{0, 0, 0}, up};
    CHECK_FALSE(is_black(mir::reflected<Lambert>(hit, s, up)));
    CHECK(is_black(mir::reflected<Lambert>(hit, s, glm::normalize(Vec3(-1, 0.5f, 0)))));
    CHECK(is_black(mir::reflected<Lambert>(hit, s, glm::normalize(Vec3(1, -0.5f, 0)))));
    CHECK(mir::reflected<Lambert>(hit, s, tilted).r == Approx(1.0f));
    CHECK(mir::reflected<Lambert>(hit, s, up).r == Approx(std::sqrt(0.5f)));
}

namespace {

/// `count` point and spot lights of powers over three decades in a slab above the origin.
Scene many_places(std::uint32_t count) {
    mir::Random random(7, mir::Stream::test, count);
    Scene s;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 at(8 * random.next() - 4, 0.2f + 2 * random.next(), 8 * random.next() - 4);
        const float light = std::pow(10.0f, 3 * random.next());
        if (i % 3 == 0) {
            mir::SpotLight spot;
            spot.position = at;
            spot.direction = mir::square_to_sphere(random.next_2d());
            spot.intensity = {light, light, light};
            spot.cos_inner = 0.8f;
            spot.cos_outer = 0.3f;
            s.spot_lights.push_back(spot);
        } else {
            s.point_lights.push_back({"bulb", at, {light, light, light}});
        }
    }
    return s;
}

}  // namespace

// H0: the mean of what the tree draws is the sum over all lights. Student's t over 4000 seeds at
// each of five receivers, for the least number of lights that join the tree and for very many.
TEST_CASE("many point and spot lights are drawn without bias", "[statistical]") {
    for (const std::uint32_t count : {17u, 100'000u}) {
        const Lit lit(many_places(count));
        REQUIRE(lit.lights.view().is_listed_in_tree);
        mir::Random random(8, mir::Stream::test, count);
        for (int i = 0; i < 5; ++i) {
            const Vec3 at(4 * random.next() - 2, 0, 4 * random.next() - 2);
            const auto expected = static_cast<double>(lit.from_listed(at, up));
            const Moments m = irradiance(lit, at, up, 140, 4);
            CAPTURE(count, i, m.mean(), expected, m.standard_error());
            CHECK(mirtest::mean_p_value(m, expected, 2e-6 * expected) > level);
            CHECK(m.standard_error() < 0.05 * expected);
        }
    }
}

TEST_CASE("a luxel's lights in the tree are not summed once more") {
    const Lit lit(many_places(17));
    const mir::ListedLight<Lambert, FreeSight> rest{
        lit.lights.view(), {}, part_beside(lit.lights.view(), 4)};
    const auto unasked = [](std::uint32_t) -> mir::Vec2 { throw 0; };
    CHECK(is_black(rest({{0, 0, 0}, up}, Lit::receiver(up), unasked)));
    CHECK(part_beside(lit.lights.view(), 0) == mir::ListedPart::all);
    CHECK(part_beside(Lit(many_places(16)).lights.view(), 4) == mir::ListedPart::all);
}

TEST_CASE("a lamp of the tree on the luxel brings nothing") {
    Scene s;
    for (int i = 0; i < 20; ++i) s.point_lights.push_back({"bulb", {0, 0, 0}, {1e3f, 1e3f, 1e3f}});
    const Lit lit(s);
    mir::Random random(9, mir::Stream::test, 0);
    CHECK(lit.from_emitters({0, 0, 0}, up, 16, random) == 0.0f);
}
