// SPDX-License-Identifier: MIT
//
// The path tracer under an environment.
#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "studio.hpp"
#include "support/catch.hpp"
#include "support/test_sky.hpp"
#include "wrong_models.hpp"

using namespace mirtest;
using mir::Lambert;
using mir::LightSearch;
using mir::Rgb;
using mir::Vec3;

namespace {

const LightSearch searches[] = {LightSearch::mis, LightSearch::lamps, LightSearch::directions};

/// A camera that sees a convex body and, past it, the sky.
mir::Scene body_under(const mir::Environment& sky, float albedo, float specular = 0.0f) {
    mir::Scene s;
    mir::Material m = mir::lambertian("body", {albedo, albedo, albedo});
    m.specular = specular;
    m.roughness = 0.4f;
    s.place(mir::builtin::box("body", s.add(m), {0, 0, 0}, {1, 0, 0.2f}, {0, 1, 0}, {-0.2f, 0, 1}));
    s.cameras = {mir::Camera::look_at({3, 2.5f, 3}, {0.4f, 0.5f, 0.6f}, {0, 1, 0}, 0.8f)};
    s.environment = sky;
    return s;
}

/// The body on a floor: both see the sky and one another.
mir::Scene corner_under(const mir::Environment& sky, float specular = 0.0f) {
    mir::Scene s = body_under(sky, 0.7f, specular);
    s.place(mir::builtin::quad("floor", 0, {-2, -0.1f, 2}, {4, 0, 0}, {0, 0, -4}));
    return s;
}

mir::ReferenceOptions samples(std::uint32_t n) {
    mir::ReferenceOptions o;
    o.samples = n;
    return o;
}

}  // namespace

TEST_CASE("Luxels that see nothing else see the environment in their direction") {
    const Studio<Lambert> studio(body_under(test_sky(), 0.5f));
    const mir::CameraRays rays = studio.rays(24, 321);
    const auto image = replicates(studio.tracer({}), rays, samples(2), 1).front().bounce(0);
    const auto sky = studio.lights.environment().view();
    int seen = 0;
    for (std::uint32_t y = 0; y < 24; ++y)
        for (std::uint32_t x = 0; x < 24; ++x) {
            const mir::Ray ray = rays(x, y);
            const bool hit = studio.engine.ray_caster().closest_hit(ray).has_value();
            REQUIRE(image(x, y) == (hit ? Rgb{} : sky.radiance(ray.direction)));
            seen += hit ? 0 : 1;
        }
    CHECK((seen > 100 && seen < 500));
}

// H0: D_1 of a convex Lambertian body of albedo rho under a constant sky of radiance L is rho L,
// and nothing is reflected twice. Every luxel by itself is exact where directions alone find the
// sky. Student's t over 32 replicates, seed 322, level 1 % over 3 tests.
TEST_CASE("A convex body in a constant sky has radiance rho L everywhere", "[statistical]") {
    const Studio<Lambert> studio(body_under(constant_sky({2, 2, 2}), 0.5f));
    const mir::CameraRays rays = studio.rays(16, 322);
    double share = 0.0;
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t x = 0; x < 16; ++x)
            share += studio.engine.ray_caster().closest_hit(rays(x, y)) ? 1.0 / 256 : 0.0;
    for (LightSearch search : searches) {
        CAPTURE(int(search));
        const auto images = replicates(studio.tracer({.light = search}), rays, samples(64), 32);
        CHECK(p_of_mean(images, 1, share, 1e-6) > sidak(0.01, 3));
        CHECK(p_of_mean(images, 1, 1.05 * share, 1e-6) < sidak(0.01, 3));
        CHECK(p_of_mean(images, 2, 0.0) == 1.0);
        if (search != LightSearch::directions) continue;
        const mir::Image<Rgb> direct = images.front().bounce(1);
        for (const Rgb& c : direct.pixels())
            REQUIRE((is_black(c) || c.g == Approx(1.0f).epsilon(1e-5)));
    }
}

// H0: ways to find light do not change the picture. Welch's test of D_1 to D_4 in tiles of 8 x 8
// luxels over 24 replicates, seeds 323 to 325, level 1 % over 2 scenes and 4 comparisons.
TEST_CASE("All ways to find the sky agree", "[statistical]") {
    const auto glossy = GENERATE(false, true);
    const Studio<mir::CookTorrance> studio(corner_under(test_sky(), glossy ? 1.0f : 0.0f));
    const auto tiles = [&](const mir::PathTracerOptions& options, std::uint64_t seed,
                           std::uint8_t b) {
        return tiles_of(replicates(studio.tracer(options), studio.rays(16, seed), samples(16), 24),
                        b, 8);
    };
    double p = 1.0;
    for (std::uint8_t b = 1; b <= 4; ++b) {
        const TileMeans both = tiles({.max_bounce = 4}, 323, b);
        p = std::min(
            p, smallest_p(both, tiles({.light = LightSearch::lamps, .max_bounce = 4}, 324, b)));
        p = std::min(
            p, smallest_p(
                   both,
                   tiles({.light_samples = 3, .directions = 2, .max_bounce = 4, .roulette_from = 1},
                         325, b)));
    }
    CHECK(p > sidak(0.01, std::size_t{2} * 4 * 2 * 4));
}

TEST_CASE("A sky that both techniques find, or one with the wrong density, is rejected",
          "[statistical]") {
    const Studio<Lambert> studio(body_under(constant_sky({2, 2, 2}), 0.5f));
    const mir::CameraRays rays = studio.rays(16, 322);
    const auto right = replicates(studio.tracer({}), rays, samples(8), 32);
    const auto p = [&](const auto& tracer) {
        return smallest_p(tiles_of(right, 1, 16),
                          tiles_of(replicates(tracer, rays, samples(8), 32), 1, 16));
    };
    CHECK(p(studio.tracer<DoubleCounting>({})) < 1e-6);
    const Studio<WrongSampleDensity> wrong(body_under(constant_sky({2, 2, 2}), 0.5f));
    CHECK(p(wrong.tracer({})) < 1e-6);
}

TEST_CASE("An environment next to lamps adds its light to theirs", "[statistical]") {
    mir::Scene lamps = corner_under(test_sky());
    lamps.place(mir::builtin::quad("lamp", lamps.add(mir::emitter("lamp", {}, {2, 3, 4})),
                                   {-1, 2, 0}, {1, 0, 0}, {0, 0, 1}));
    mir::Scene dark = lamps;
    dark.environment.reset();
    mir::Scene sky = lamps;
    sky.materials.back().emission = {};
    const auto image = [&](const mir::Scene& scene, std::uint64_t seed) {
        const Studio<Lambert> studio(scene);
        return replicates(studio.tracer({.max_bounce = 4}), studio.rays(16, seed), samples(16), 24);
    };
    const auto both = image(lamps, 326);
    const auto alone = image(dark, 327);
    const auto outside = image(sky, 328);
    // H0: D_b of both is the sum. Student's t over 24 differences, level 1 % over 3 bounces.
    for (std::uint8_t b = 1; b <= 3; ++b) {
        Moments m;
        const auto mean = [&](const auto& images, std::size_t r) {
            TileMeans t(16);
            t.add(images[r].bounce(b));
            return t.moments().front().mean();
        };
        for (std::size_t r = 0; r < both.size(); ++r)
            m.add(mean(both, r) - mean(alone, r) - mean(outside, r));
        CAPTURE(int(b), m.mean(), m.standard_error());
        CHECK(mean_p_value(m, 0.0) > sidak(0.01, 3));
    }
}
