// SPDX-License-Identifier: MIT
#include "mir/scene/light_table.hpp"

#include "mir/core/random.hpp"
#include "mir/scene/shapes.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <limits>

namespace {

using mir::EmitterSample;
using mir::LightTable;
using mir::Rgb;
using mir::Scene;
using mir::Vec2;
using mir::Vec3;
using mir::WorldGeometry;
using mirtest::Approx;
namespace builtin = mir::builtin;

Rgb white(float v) { return {v, v, v}; }

/// Lamps of different size, brightness and sides besides a dark wall, and one light of each kind.
Scene lamps() {
    Scene s;
    const std::uint32_t wall = s.add(mir::lambertian("wall", white(0.5f)));
    const std::uint32_t dim = s.add(mir::emitter("dim", {}, white(1.0f)));
    mir::Material bright = mir::emitter("bright", {}, {8, 2, 1});
    bright.emits_from_both_sides = true;
    bright.light_group = 3;
    const std::uint32_t both = s.add(bright);
    s.place(builtin::quad("wall", wall, {-2, -1, -2}, {0, 0, 4}, {4, 0, 0}));
    s.place(builtin::quad("dim", dim, {0, 1, 0}, {1, 0, 0}, {0.3f, 0, 2}));
    s.place(builtin::disc("bright", both, {0, 2, 0}, {0, 1, 0}, {1, 0, 0}, 0.5f, 5));
    return s;
}
Scene all_kinds() {
    Scene s = lamps();
    s.point_lights.push_back({"bulb", {0, 0, 0}, {1, 2, 3}});
    mir::SpotLight spot;
    spot.intensity = white(4.0f);
    spot.cos_inner = 0.9f;
    spot.cos_outer = 0.6f;
    s.spot_lights.push_back(spot);
    s.directional_lights.push_back({"sun", {0, -1, 0}, white(2.0f)});
    return s;
}

/// Test of sample_emitter() on the four congruent parts of each emissive triangle.
/// `probability(t)` is that of triangle t.
template <class Probability>
double emitter_p_value(const LightTable& table, std::uint64_t seed,
                       const Probability& probability) {
    const auto triangles = table.lamps().triangles();
    std::vector<double> observed(triangles.size() * 4);
    std::vector<double> expected;
    constexpr double draws = 50'000;
    mir::Random random(seed, mir::Stream::test, 0);
    for (int i = 0; i < static_cast<int>(draws); ++i) {
        const float u = random.next();
        const EmitterSample s = table.sample_emitter(u, random.next_2d());
        const auto found = std::lower_bound(triangles.begin(), triangles.end(), s.triangle);
        // The midpoints of its sides cut a triangle into four.
        const Vec2 b = s.barycentrics;
        const int part = b.x > 0.5f ? 0 : b.y > 0.5f ? 1 : b.x + b.y < 0.5f ? 2 : 3;
        ++observed[static_cast<std::size_t>((found - triangles.begin()) * 4 + part)];
    }
    for (std::size_t i = 0; i < observed.size(); ++i)
        expected.push_back(draws / 4 * probability(triangles[i / 4]));
    return mirtest::chi_square(observed, expected).p_value;
}

}  // namespace

TEST_CASE("emissive triangles are listed in order, with their power as luminance") {
    const Scene s = lamps();
    const WorldGeometry g(s);
    const LightTable table(s, g);
    REQUIRE(table.lamps().triangles().size() == 2 + 5);
    CHECK(table.lamps().triangles().front() == 2);
    CHECK(table.lamps().triangles().back() == 8);
    CHECK(table.has_emitters());
    const double disc = 0.25 * mirtest::pi;
    const double bright = static_cast<double>(mir::luminance(mir::Rgb{8, 2, 1}));
    CHECK(table.power() == Approx(mirtest::pi * (2.0 + 2 * disc * bright)).epsilon(1e-5));
}

TEST_CASE("every kind of light counts with the power it sends into the scene") {
    const Scene s = all_kinds();
    const WorldGeometry g(s);
    const LightTable table(s, g);
    const Scene without_delta_lights = lamps();
    const LightTable area(without_delta_lights, g);
    const auto point = static_cast<double>(mir::luminance(mir::Rgb{1, 2, 3})) * 4 * mirtest::pi;
    // The falloff over the ring, integrated numerically.
    const double spot =
        4 * mirtest::integrate(0.6, 1.0, 4000, [&](double c) {
            return 2 * mirtest::pi *
                   static_cast<double>(source_of(s.spot_lights[0], {})
                                           .share({0, 0, -1}, mirtest::direction(-c, 0)));
        });
    const auto radius = static_cast<double>(g.bounds().diagonal()) / 2;
    const double sun = 2 * mirtest::pi * radius * radius;
    CHECK(table.power() - area.power() == Approx(point + spot + sun).epsilon(1e-4));
    CHECK(table.light_probability(7) == Approx(point / table.power()));
    CHECK(table.light_probability(8) == Approx(spot / table.power()).epsilon(1e-3));
    CHECK(table.light_probability(9) == Approx(sun / table.power()));
    CHECK(table.sphere().radius == Approx(radius));
    CHECK(table.sphere().centre == g.bounds().centre());
}

TEST_CASE("densities of emitter points are one over area times the share of power") {
    const Scene s = lamps();
    const WorldGeometry g(s);
    const LightTable table(s, g);
    double total = 0.0;
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t)
        total += static_cast<double>(table.emitter_pdf(t)) * static_cast<double>(g.area(t));
    CHECK(total == Approx(1.0).epsilon(1e-6));
    CHECK(table.emitter_pdf(0) == 0.0f);
    CHECK(table.emitter_pdf(1) == 0.0f);
    CHECK(table.emitter_pdf(1000) == 0.0f);
    // Power over area is radiance and sides: the same on all triangles of one lamp.
    CHECK(table.emitter_pdf(8) / table.emitter_pdf(2) ==
          Approx(2 * mir::luminance(mir::Rgb{8, 2, 1})).epsilon(1e-5));
}

TEST_CASE("an emitter sample describes a point on its triangle") {
    const Scene s = lamps();
    const WorldGeometry g(s);
    const LightTable table(s, g);
    mir::Random random(1, mir::Stream::test, 0);
    for (int i = 0; i < 500; ++i) {
        const float u = random.next();
        const EmitterSample e = table.sample_emitter(u, random.next_2d());
        const bool bright = e.triangle >= 4;
        CHECK(e.pdf_area == Approx(table.emitter_pdf(e.triangle)).epsilon(1e-5));
        CHECK(e.normal == g.front_normal(e.triangle));
        CHECK(e.both_sides == bright);
        CHECK(e.light_group == (bright ? 3 : 0));
        CHECK(e.radiance == (bright ? Rgb{8, 2, 1} : white(1.0f)));
        const Vec3 p = g.surface_point(e.triangle, e.barycentrics, -e.normal).position;
        CHECK(e.position == p);
        CHECK(std::fabs(glm::dot(p - g.corner(e.triangle, 0), e.normal)) < 1e-6f);
    }
    const EmitterSample alone = table.lamps().view().point_on(g.view(), 6, {0.2f, 0.3f});
    CHECK(alone.triangle == 8);
    CHECK(alone.pdf_area == Approx(1 / g.area(8)));
}

// H0: triangles come by power and points uniformly. Chi-square on 7 triangles of 4 parts, level 1
// %, seed 141. Choice by area alone must be rejected.
TEST_CASE("emitter points follow their density over all triangles", "[statistical]") {
    const Scene s = lamps();
    const WorldGeometry g(s);
    const LightTable table(s, g);
    const auto by_power = [&](std::uint32_t t) {
        return static_cast<double>(table.emitter_pdf(t)) * static_cast<double>(g.area(t));
    };
    CHECK(emitter_p_value(table, 141, by_power) > 0.01);
    const double area = 2.0 + 0.25 * mirtest::pi;
    const auto by_area = [&](std::uint32_t t) { return static_cast<double>(g.area(t)) / area; };
    CHECK(emitter_p_value(table, 141, by_area) < 0.01);
}

// H0: lights come by power. Chi-square on 10 lights, level 1 %, seed 142; equal odds are rejected.
TEST_CASE("lights are chosen by power", "[statistical]") {
    const Scene s = all_kinds();
    const WorldGeometry g(s);
    const LightTable table(s, g);
    std::vector<double> observed(10), expected, equal(10, 5000.0);
    mir::Random random(142, mir::Stream::test, 0);
    for (int i = 0; i < 50'000; ++i) ++observed[table.sample_light(random.next())];
    for (std::uint32_t i = 0; i < 10; ++i)
        expected.push_back(50'000 * static_cast<double>(table.light_probability(i)));
    CHECK(mirtest::chi_square(observed, expected).p_value > 0.01);
    CHECK(mirtest::chi_square(observed, equal).p_value < 0.01);
}

TEST_CASE("scenes without light have an empty table") {
    Scene s;
    s.place(builtin::quad("wall", s.add({}), {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    const WorldGeometry g(s);
    const LightTable dark(s, g);
    CHECK(dark.empty());
    CHECK_FALSE(dark.has_emitters());
    CHECK(dark.power() == 0.0);
    CHECK(dark.emitter_pdf(0) == 0.0f);
    // A bulb that is switched off is listed and never chosen.
    s.point_lights.push_back({"off", {0, 0, 0}, {}});
    CHECK(LightTable(s, g).empty());
    s.point_lights.push_back({"on", {0, 0, 0}, white(1)});
    const LightTable lit(s, g);
    for (float u : {0.0f, 0.5f, 0x1.fffffep-1f}) CHECK(lit.sample_light(u) == 1);
    CHECK_FALSE(lit.has_emitters());
}

TEST_CASE("emission that cannot be sampled is refused with the name of its light") {
    const float bad = GENERATE(-1.0f, std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN());
    const WorldGeometry g(lamps());
    const auto refused = [&](const Scene& s, const std::string& who) {
        try {
            const LightTable table(s, g);
            FAIL("no error for " << who);
        } catch (const mir::Error& e) {
            CAPTURE(e.what());
            CHECK(e.code() == mir::ErrorCode::invalid_input);
            CHECK(std::string(e.what()).find(who) != std::string::npos);
        }
    };
    Scene s = all_kinds();
    s.materials[1].emission.g = bad;
    refused(s, "material 'dim'");
    s = all_kinds();
    s.point_lights[0].intensity.r = bad;
    refused(s, "point light 'bulb'");
    s = all_kinds();
    s.directional_lights[0].irradiance.b = bad;
    refused(s, "directional light 'sun'");
    s = all_kinds();
    s.spot_lights[0].intensity.b = bad;
    refused(s, "spot light ''");
}

TEST_CASE("light whose power is no number is refused with the name of its light and a remedy") {
    const auto refused = [&](const Scene& s, const std::string& who) {
        const WorldGeometry g(s);
        try {
            const LightTable table(s, g);
            FAIL("no error for " << who);
        } catch (const mir::Error& e) {
            CAPTURE(e.what());
            CHECK(e.code() == mir::ErrorCode::invalid_input);
            CHECK(std::string(e.what()).starts_with(who + " more power than 32-bit"));
            CHECK(std::string(e.what()).find("; lower the emission") != std::string::npos);
        }
    };
    Scene s = lamps();
    s.materials[1].emission.g = 3e38f;
    s.instances[1].to_world = mir::Mat4(mir::Mat3(10.0f));
    refused(s, "material 'dim' emits");
    s = lamps();
    s.materials[1].emission.g = 1e20f;
    s.instances[1].to_world = mir::Mat4(mir::Mat3(1e10f));
    refused(s, "material 'dim' emits");
    s = all_kinds();
    s.point_lights[0].intensity = white(3e37f);
    refused(s, "point light 'bulb' emits");
    s = all_kinds();
    s.spot_lights[0].intensity = white(3e38f);
    refused(s, "spot light '' emits");
    s = all_kinds();
    s.directional_lights[0].irradiance = white(3e37f);
    refused(s, "directional light 'sun' emits");
    s = lamps();
    s.point_lights.assign(3, {"bulb", {0, 0, 0}, white(2e37f)});
    refused(s, "all lights together emit");
    s = lamps();
    s.environment.emplace();
    s.environment->name = "sky";
    s.environment->radiance = mir::Image<Rgb>({2, 1}, white(1e35f));
    s.instances[0].to_world = mir::Mat4(mir::Mat3(1e3f));
    refused(s, "environment 'sky' emits");
}
