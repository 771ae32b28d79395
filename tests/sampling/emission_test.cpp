// SPDX-License-Identifier: MIT
#include "mir/sampling/emission.hpp"

#include "mir/scene/shapes.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"
#include "support/test_sky.hpp"

namespace {

using mir::Emission;
using mir::PathNumbers;
using mir::Rgb;
using mir::Scene;
using mir::Sequence;
using mir::Stream;
using mir::Vec3;
using mirtest::Approx;
using mirtest::Histogram;
namespace builtin = mir::builtin;

// Every test of a distribution in this file belongs to one family of level 1 %.
const double level = mirtest::sidak(0.01, 15);
constexpr std::uint64_t draws = 40'000;

struct Lit {
    Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};

    explicit Lit(Scene s) : scene(std::move(s)) {}
    Emission emission(std::uint64_t seed, std::uint64_t path) const {
        PathNumbers numbers(Sequence::random, seed, Stream::test, path);
        return mir::sample_emission(lights, numbers);
    }
};

Scene room() {
    Scene s;
    s.place(builtin::box("room", s.add(mir::lambertian("wall", {1, 1, 1})), {-1, -2, -3}, {3, 0, 0},
                         {0, 4, 0}, {0, 0, 5}));
    return s;
}
Scene lamp(bool both_sides) {
    Scene s = room();
    mir::Material m = mir::emitter("lamp", {}, {3, 2, 1});
    m.emits_from_both_sides = both_sides;
    m.light_group = 5;
    s.place(builtin::quad("lamp", s.add(m), {0, 0, 0}, {1, 0, 0.5f}, {0, 1, 0.25f}));
    return s;
}
Scene bulb() {
    Scene s = room();
    s.point_lights.push_back({"bulb", {0.5f, 0, 0}, {1, 2, 3}, 6});
    return s;
}
Scene spot() {
    Scene s = room();
    mir::SpotLight l;
    l.position = {0, 1, 0};
    l.direction = glm::normalize(Vec3(1, -2, 0.5f));
    l.intensity = {4, 5, 6};
    l.cos_inner = 0.9f;
    l.cos_outer = 0.5f;
    l.light_group = 7;
    s.spot_lights.push_back(l);
    return s;
}
Scene sun() {
    Scene s = room();
    s.directional_lights.push_back({"sun", glm::normalize(Vec3(1, -3, 2)), {2, 2, 1}, 8});
    return s;
}
Scene sky() {
    Scene s = room();
    s.environment = mirtest::test_sky();
    return s;
}
Scene everything() {
    Scene s = lamp(true);
    s.point_lights = bulb().point_lights;
    s.spot_lights = spot().spot_lights;
    s.directional_lights = sun().directional_lights;
    s.environment = mirtest::test_sky();
    return s;
}

/// Emitted directions around `axis`, on the square of (cosine / 2 + 1 / 2, azimuth).
Histogram directions(const Lit& lit, Vec3 axis, std::uint64_t seed) {
    Histogram h(20, 16);
    const mir::Frame frame = mir::Frame::around(axis);
    for (std::uint64_t i = 0; i < draws; ++i) {
        const Vec3 w = frame.to_local(lit.emission(seed, i).ray.direction);
        h.add(0.5 + 0.5 * static_cast<double>(w.z),
              mirtest::turn(static_cast<double>(w.x), static_cast<double>(w.y)));
    }
    return h;
}

double front_cosine(double x, double /*y*/) { return 4 * std::max(2 * x - 1, 0.0); }
double both_cosines(double x, double /*y*/) { return 2 * std::fabs(2 * x - 1); }
double uniform(double /*x*/, double /*y*/) { return 1.0; }

}  // namespace

// H0: emitted power averages to that of the table. Student's t over 40 000 paths, seed 161, family
// level 1 %; 1e-5 of rounding is allowed. 1.03 times the power must be rejected.
TEST_CASE("the power of emissions averages to the power of the lights", "[statistical]") {
    const std::vector<std::pair<const char*, Scene>> scenes{{"lamp", lamp(false)},
                                                            {"both sides", lamp(true)},
                                                            {"bulb", bulb()},
                                                            {"spot", spot()},
                                                            {"sun", sun()},
                                                            {"sky", sky()},
                                                            {"everything", everything()}};
    for (const auto& [name, scene] : scenes) {
        const Lit lit(scene);
        mirtest::Moments power;
        for (std::uint64_t i = 0; i < draws; ++i)
            power.add(static_cast<double>(mir::luminance(lit.emission(161, i).power)));
        const double expected = lit.lights.power();
        CAPTURE(name);
        CHECK(mirtest::mean_p_value(power, expected, 1e-5 * expected) > level);
        CHECK(mirtest::mean_p_value(power, 1.03 * expected, 1e-5 * expected) < level);
    }
}

// H0 of the next tests: chi-square on 20 x 16 cells, family level 1 %, seeds 162 to 168; wrong
// densities must be rejected.
TEST_CASE("a lamp emits by the cosine from its front", "[statistical]") {
    const Lit lit(lamp(false));
    const Histogram h = directions(lit, lit.geometry.front_normal(12), 162);
    CHECK(h.against(front_cosine).p_value > level);
    CHECK(h.against(both_cosines).p_value < level);
    CHECK(h.against(uniform).p_value < level);
}

TEST_CASE("a lamp of both sides emits by the cosine from each", "[statistical]") {
    const Lit lit(lamp(true));
    const Histogram h = directions(lit, lit.geometry.front_normal(12), 163);
    CHECK(h.against(both_cosines).p_value > level);
    CHECK(h.against(front_cosine).hit_impossible_cell);
}

TEST_CASE("a bulb emits in all directions alike", "[statistical]") {
    CHECK(directions(Lit(bulb()), {0, 0, 1}, 164).against(uniform).p_value > level);
}

TEST_CASE("a spot emits uniformly inside its outer cone", "[statistical]") {
    const Lit lit(spot());
    const Histogram h = directions(lit, lit.scene.spot_lights[0].direction, 165);
    CHECK(h.against([](double x, double) { return x > 0.75 ? 4.0 : 0.0; }).p_value > level);
    CHECK(h.against([](double x, double) { return x > 0.7 ? 1 / 0.3 : 0.0; }).p_value < level);
}

TEST_CASE("the sun's rays are parallel and uniform over a disc that covers the scene",
          "[statistical]") {
    const Lit lit(sun());
    const Vec3 towards = lit.scene.directional_lights[0].direction;
    const mir::Frame frame = mir::Frame::around(towards);
    const float radius = lit.lights.sphere().radius;
    Histogram h(20, 16);
    for (std::uint64_t i = 0; i < draws; ++i) {
        const Emission e = lit.emission(166, i);
        CHECK(e.ray.direction == towards);
        const Vec3 p = frame.to_local(e.ray.origin - lit.lights.sphere().centre) / radius;
        CHECK(p.z == Approx(-2.0f).epsilon(1e-5));
        const auto x = static_cast<double>(p.x);
        const auto y = static_cast<double>(p.y);
        h.add((x * x + y * y) * (1 - 1e-5), mirtest::turn(x, y));
    }
    CHECK(h.against(uniform).p_value > level);
}

TEST_CASE("a sky's rays come by its luminance, uniform over a disc that covers the scene",
          "[statistical]") {
    const Lit lit(sky());
    const auto around = lit.lights.environment().view();
    const float radius = lit.lights.sphere().radius;
    Histogram disc(20, 16);
    Histogram direction(24, 24);
    for (std::uint64_t i = 0; i < draws; ++i) {
        const Emission e = lit.emission(168, i);
        const Vec3 w = e.ray.direction;
        CHECK(e.light_group == 9);
        const Vec3 p =
            mir::Frame::around(w).to_local(e.ray.origin - lit.lights.sphere().centre) / radius;
        CHECK(p.z == Approx(-2.0f).epsilon(1e-5));
        const auto x = static_cast<double>(p.x);
        const auto y = static_cast<double>(p.y);
        disc.add((x * x + y * y) * (1 - 1e-5), mirtest::turn(x, y));
        direction.add(0.5 + 0.5 * static_cast<double>(w.y),
                      mirtest::turn(static_cast<double>(-w.x), static_cast<double>(-w.z)));
    }
    CHECK(disc.against(uniform).p_value > level);
    const auto density = [&](double x, double y) {
        const double cosine = 1 - 2 * x;
        const double sine = std::sqrt(1 - cosine * cosine);
        const Vec3 towards(sine * std::cos(2 * mirtest::pi * y), cosine,
                           sine * std::sin(2 * mirtest::pi * y));
        return 4 * mirtest::pi * static_cast<double>(around.density(around.radiance(towards)));
    };
    CHECK(direction.against(density, 25).p_value > level);
    CHECK(direction.against(uniform).p_value < level);
}

TEST_CASE("lamp points are uniform over the lamp", "[statistical]") {
    const Lit lit(lamp(true));
    Histogram h(20, 16);
    for (std::uint64_t i = 0; i < draws; ++i) {
        const Vec3 p = lit.emission(167, i).emitter.position;  // a (1,0,.5) + b (0,1,.25)
        h.add(static_cast<double>(p.x), static_cast<double>(p.y));
    }
    CHECK(h.against(uniform).p_value > level);
}

TEST_CASE("an emission from a lamp knows its place, side and density") {
    const Lit lit(lamp(true));
    const Vec3 front = lit.geometry.front_normal(12);
    const float area = lit.geometry.area(12) + lit.geometry.area(13);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Emission e = lit.emission(1, i);
        REQUIRE(e.is_lamp);
        CHECK(e.light_group == 5);
        CHECK(std::fabs(glm::dot(e.emitter.normal, front)) == Approx(1.0f));
        CHECK(glm::dot(e.ray.direction, e.emitter.normal) > 0.0f);
        CHECK(e.ray.origin == e.emitter.position);
        CHECK(e.pdf_point == Approx(0.5f / area));
        CHECK(e.power.r == Approx(3 * mir::pi * 2 * area));
        CHECK(e.power.b == Approx(1 * mir::pi * 2 * area));
    }
}

TEST_CASE("lights without extent have no emitter and keep their group and colour") {
    const Emission point = Lit(bulb()).emission(1, 0);
    CHECK_FALSE(point.is_lamp);
    CHECK(point.light_group == 6);
    CHECK(point.ray.origin == Vec3(0.5f, 0, 0));
    CHECK(point.power.g == Approx(2 * 4 * mir::pi));
    CHECK(Lit(spot()).emission(1, 0).light_group == 7);
    CHECK(Lit(sun()).emission(1, 0).light_group == 8);
}

TEST_CASE("every emission takes five numbers whatever the light") {
    const Lit lit(everything());
    for (std::uint64_t i = 0; i < 50; ++i) {
        PathNumbers used(Sequence::random, 2, Stream::test, i);
        PathNumbers skipped = used;
        mir::sample_emission(lit.lights, used);
        for (int k = 0; k < 5; ++k) skipped.next();
        CHECK(used.next() == skipped.next());
    }
}
