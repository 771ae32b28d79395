// SPDX-License-Identifier: MIT
#include "mir/data/gbuffer.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/analytic_sphere.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/statistics.hpp"

#include <array>
#include <cmath>

// Light inside a sphere with Lambertian walls has no variance: whatever the VPLs, each lights every
// point alike (docs/method.md, 9.3). What is left to see is an error.

namespace {

using mir::InstantRadiosityOptions;
using mir::Lambert;
using mir::Termination;
using mir::Vec3;
using mir::VplList;
using mirtest::AnalyticSphere;
using mirtest::Approx;
using Sampler = mir::InstantRadiositySampler<Lambert, AnalyticSphere>;

static_assert(mir::RayCaster<AnalyticSphere>);

constexpr float radius = 2.0f;
constexpr double intensity = 3.0;  // of the bulb at the centre, W sr^-1
const double power = 4 * mirtest::pi * intensity;

/// Bulb at the centre of a sphere whose halves reflect `upper` and `lower`. A box around it stands
/// in for the mesh, from which the sampler takes the scale and the mean reflectance.
struct Sphere {
    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Lambert> surfaces{scene};

    Sphere(float upper, float lower) {
        const std::uint32_t a = scene.add(mir::lambertian("upper", {upper, upper, upper}));
        scene.add(mir::lambertian("lower", {lower, lower, lower}));
        scene.place(mir::builtin::box("box", a, Vec3(-radius), {2 * radius, 0, 0},
                                      {0, 2 * radius, 0}, {0, 0, 2 * radius}));
        const auto i = static_cast<float>(intensity);
        scene.point_lights.push_back({"bulb", {0, 0, 0}, {i, i, i}});
        geometry = mir::WorldGeometry(scene);
        lights = mir::LightTable(scene, geometry);
        surfaces = mir::SurfaceTable<Lambert>(scene);
    }
    AnalyticSphere caster() const { return {radius, 0, 1}; }
    VplList vpls(const InstantRadiosityOptions& options) const {
        mir::InlineExecutor executor;
        return aggregate(Sampler({geometry, lights, surfaces, caster()}, options).sample(executor));
    }
    /// The VPLs lie on a sphere that is smaller by the offset; so do lifted luxels.
    double lifted_radius() const { return static_cast<double>(radius - geometry.ray_offset()); }
};

using GBuffer = mir::BlockedGBuffer<Lambert::Params>;

/// 8 x 8 luxels spread over the sphere, in four tiles.
GBuffer luxels(const Sphere& sphere) {
    GBuffer g({8, 8}, {4, 4});
    for (mir::TileIndex t = 0; t < g.tiles().size(); ++t) {
        const mir::Tile tile = g.tiles()[t];
        const auto layout = mir::BlockedLayout::of(tile);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const mir::Vec2 u = (mir::Vec2(tile.x + x, tile.y + y) + 0.5f) / 8.0f;
                const mir::SurfacePoint p = sphere.caster().point(mir::square_to_sphere(u));
                const Vec3 n = p.geometric_normal;
                g.store(t, layout(x, y), {mir::lift(p), n},
                        {n, n, {}, sphere.surfaces.params(p.material)});
            }
    }
    return g;
}

mir::Image<mir::Rgb> image(const GBuffer& g, mir::VplSpan<mir::Space::host> vpls) {
    mir::InlineExecutor executor;
    return mir::reconstruct(mir::sched::Cpu{executor}, g, vpls, mirtest::FreeSight{},
                            mir::VplShading<Lambert>{});
}

double sum_of_intensities(std::span<const mir::Vpl> vpls) {
    double sum = 0.0;
    for (const mir::Vpl& vpl : vpls) sum += static_cast<double>(vpl.intensity.g);
    return sum;
}

InstantRadiosityOptions options(Termination termination, std::uint64_t seed = 5) {
    InstantRadiosityOptions o;
    o.vpls = 200;
    o.termination = termination;
    o.seed = seed;
    return o;
}

}  // namespace

TEST_CASE("cos cos / d^2 is 1 / (4 R^2) for every pair of points of a sphere") {
    const AnalyticSphere sphere{radius, 0, 0};
    mir::Random random(1, mir::Stream::test, 0);
    for (int i = 0; i < 1000; ++i) {
        const auto a = sphere.point(mir::square_to_sphere(random.next_2d()));
        const auto b = sphere.point(mir::square_to_sphere(random.next_2d()));
        const Vec3 d = b.position - a.position;
        const float length = glm::length(d);
        if (length < 0.1f) continue;
        const float g =
            mir::geometry_term(d / length, 1.0f / length, a.shading_normal, b.geometric_normal);
        CHECK(g * 4 * radius * radius == Approx(1.0f).epsilon(1e-4));
    }
}

TEST_CASE("rays inside the analytic sphere meet it opposite, with the normal towards them") {
    const AnalyticSphere sphere{radius, 3, 4};
    const auto up = sphere.closest_hit({{0.5f, 0, 0}, {0, 1, 0}});
    REQUIRE(up);
    CHECK(up->position.y == Approx(std::sqrt(4 - 0.25)));
    CHECK(glm::dot(up->geometric_normal, Vec3(0, 1, 0)) < 0.0f);
    CHECK(up->material == 3);
    CHECK(sphere.closest_hit({{0.5f, 0, 0}, {0, -1, 0}})->material == 4);
    CHECK_FALSE(sphere.closest_hit({{0, 3, 0}, {0, 1, 0}}));
}

TEST_CASE("every bounce is constant over the sphere, sum of J times rho / (4 pi R^2)") {
    const Sphere sphere(0.6f, 0.6f);
    const GBuffer g = luxels(sphere);
    const auto termination = GENERATE(Termination::roulette, Termination::levels);
    const VplList vpls = sphere.vpls(options(termination));
    REQUIRE(vpls.size() > 150);
    const double r = sphere.lifted_radius();
    for (std::uint8_t b = 2; b <= vpls.max_bounce(); ++b) {
        const std::vector<mir::Vpl> bounce = vpls.bounce(b);
        const double expected = sum_of_intensities(bounce) * 0.6 / mirtest::pi / (4 * r * r);
        const auto picture = image(g, span_of(bounce));
        CAPTURE(int{b});
        for (const mir::Rgb& l : picture.pixels()) REQUIRE(l.g == Approx(expected).epsilon(1e-5));
    }
}

TEST_CASE("with levels each bounce is rho times the one before, to rounding") {
    const Sphere sphere(0.6f, 0.6f);
    const GBuffer g = luxels(sphere);
    const VplList vpls = sphere.vpls(options(Termination::levels));
    const double r = sphere.lifted_radius();
    double bounce = 0.6 * power * 0.6 / mirtest::pi / mirtest::pi / (4 * r * r);  // D_2
    for (std::uint8_t b = 2; b <= vpls.max_bounce(); ++b, bounce *= 0.6) {
        const std::vector<mir::Vpl> lit = vpls.bounce(b);
        const auto picture = image(g, span_of(lit));
        CAPTURE(int{b});
        for (const mir::Rgb& l : picture.pixels()) REQUIRE(l.g == Approx(bounce).epsilon(1e-5));
    }
    CHECK(vpls.max_bounce() > 8);
}

TEST_CASE("a bright cap lights the sphere with rho L A / (4 pi R^2)") {
    const Sphere sphere(0.6f, 0.6f);
    constexpr std::uint32_t count = 100;
    const float cap = 2 * mir::pi * radius * radius * 0.1f;  // area of a cap of height R / 10
    VplList vpls;
    mir::Random random(2, mir::Stream::test, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto p = sphere.caster().point(mir::square_to_cone(random.next_2d(), 0.9f));
        const float j = 7.0f * cap / count;
        const float offset = sphere.geometry.ray_offset();
        vpls.push_back(
            {mir::lift(p.position, p.geometric_normal, offset), p.geometric_normal, {j, j, j}}, {});
    }
    const double r = sphere.lifted_radius();
    const double expected = 0.6 * 7 * static_cast<double>(cap) / (4 * mirtest::pi * r * r);
    const auto picture = image(luxels(sphere), vpls.span());
    for (const mir::Rgb& l : picture.pixels()) CHECK(l.r == Approx(expected).epsilon(1e-5));
}

TEST_CASE("the furnace: where every wall emits L and reflects rho, radiance is L / (1 - rho)") {
    // Inside a sphere all walls together send out the power of the bulb when L = power / (pi A),
    // and light of any origin arrives evenly: the bulb stands in for them from bounce 2 on. What
    // flooring cuts off after bounce B is rho^(B+1) of the whole, exactly.
    const Sphere sphere(0.6f, 0.6f);
    const GBuffer g = luxels(sphere);
    const double r = sphere.lifted_radius();
    const double emission = power / (mirtest::pi * 4 * mirtest::pi * r * r);
    VplList walls;
    constexpr std::uint32_t count = 64;
    for (std::uint32_t i = 0; i < count; ++i) {
        const mir::Vec2 u((static_cast<float>(i) + 0.5f) / count, static_cast<float>(i % 8) / 8.0f);
        const auto p = sphere.caster().point(mir::square_to_sphere(u));
        const auto j = static_cast<float>(power / mirtest::pi / count);
        const Vec3 at = mir::lift(p);
        walls.push_back({at, p.geometric_normal, {j, j, j}}, {});
    }
    const VplList vpls = sphere.vpls(options(Termination::levels));
    const auto first = image(g, walls.span());
    const auto rest = image(g, vpls.span());
    const double cut = std::pow(0.6, vpls.max_bounce() + 1);
    for (std::size_t i = 0; i < first.pixels().size(); ++i) {
        const double radiance = emission + static_cast<double>(first.pixels()[i].g) +
                                static_cast<double>(rest.pixels()[i].g);
        REQUIRE(radiance == Approx(emission * (1 - cut) / (1 - 0.6)).epsilon(1e-5));
    }
}

TEST_CASE("halves that reflect differently differ by nothing but their reflectance") {
    const Sphere sphere(0.8f, 0.2f);
    const VplList vpls = sphere.vpls(options(Termination::roulette));
    const double r = sphere.lifted_radius();
    const double arriving = sum_of_intensities(vpls.vpls()) / (4 * r * r);
    const auto picture = image(luxels(sphere), vpls.span());
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            const double rho = y < 4 ? 0.8 : 0.2;
            // square_to_sphere turns with y: the first half of a turn has positive sines.
            CHECK(picture(x, y).b == Approx(arriving * rho / mirtest::pi).epsilon(1e-5));
        }
}

// H0: bounce b sends out power times mean reflectance^(b-1). Student's t over 100 seeds from 451
// on, level 1 % over 4 bounces; a mean reflectance 5 % off is rejected at bounce 3.
TEST_CASE("halves that reflect differently reflect their mean on average", "[statistical]") {
    const Sphere sphere(0.8f, 0.2f);
    std::array<mirtest::Moments, 6> sums;
    for (std::uint64_t seed = 451; seed < 551; ++seed) {
        const VplList vpls = sphere.vpls(options(Termination::roulette, seed));
        for (std::uint8_t b = 2; b <= 5; ++b)
            sums[b].add(mirtest::pi * sum_of_intensities(vpls.bounce(b)));
    }
    for (int b = 2; b <= 5; ++b) {
        CAPTURE(b);
        CHECK(mirtest::mean_p_value(sums[static_cast<std::size_t>(b)],
                                    power * std::pow(0.5, b - 1)) > mirtest::sidak(0.01, 4));
    }
    CHECK(mirtest::mean_p_value(sums[3], power * 0.25 * 1.05) < mirtest::sidak(0.01, 4));
}
