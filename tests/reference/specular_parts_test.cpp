// SPDX-License-Identifier: MIT
//
// Light through mirrors and glass, by parts and by both directions.
#include "mir/sampling/caustic_tracer.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "studio.hpp"
#include "support/catch.hpp"
#include "support/test_sky.hpp"

using namespace mirtest;
using mir::CookTorrance;
using mir::PathPart;
using mir::Rgb;
using mir::Vec3;

namespace {

/// A floor and a wall between a mirror, a ball of glass and a lamp.
mir::Scene glass_corner() {
    mir::Scene s;
    mir::Material mirror;
    mirror.base_color = {0.9f, 0.8f, 0.7f};
    mirror.metallic = 1.0f;
    mirror.roughness = 0.0f;
    mir::Material glass;
    glass.base_color = {1, 1, 1};
    glass.roughness = 0.0f;
    glass.transmission = 1.0f;
    glass.is_thin = false;
    const std::uint32_t floor = s.add(mir::lambertian("floor", {0.6f, 0.5f, 0.4f}));
    s.place(mir::builtin::quad("floor", floor, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    s.place(mir::builtin::quad("wall", floor, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}));
    s.place(mir::builtin::quad("mirror", s.add(mirror), {1, 0, -1}, {0, 0, 2}, {0, 2, 0}));
    s.place(mir::builtin::sphere("ball", s.add(glass), {-0.3f, 0.5f, 0.1f}, 0.4f, 24, 12));
    s.place(mir::builtin::quad("lamp", s.add(mir::emitter("lamp", {}, {8, 8, 8})),
                               {-0.5f, 1.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}));
    s.cameras = {mir::Camera::look_at({-0.4f, 1.2f, 3.4f}, {0, 0.7f, 0}, {0, 1, 0}, 0.7f)};
    return s;
}

mir::ReferenceOptions samples(std::uint32_t n) {
    mir::ReferenceOptions o;
    o.samples = n;
    return o;
}

std::vector<mir::ReferenceImage> images(const Studio<CookTorrance>& studio, PathPart part,
                                        std::uint64_t seed) {
    mir::PathTracerOptions options;
    options.paths = part;
    options.max_bounce = 3;
    return replicates(studio.tracer(options), studio.rays(16, seed), samples(32), 24);
}

}  // namespace

// H0: what is gathered and the residual are all paths, each once. Welch's test of D_1 to D_3 over
// 24 replicates, seeds 930 to 932, level 1 % over 3 comparisons.
TEST_CASE("the parts of paths add up to all of them", "[statistical]") {
    const Studio<CookTorrance> studio(glass_corner());
    const auto all = images(studio, PathPart::all, 930);
    const auto gathered = images(studio, PathPart::gathered, 931);
    const auto residual = images(studio, PathPart::residual, 932);
    for (std::uint8_t b = 1; b <= 3; ++b) {
        CAPTURE(int(b));
        Moments whole;
        Moments parts;
        Moments doubled;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto mean = [b](const mir::ReferenceImage& image) {
                const mir::Image<Rgb> light = image.bounce(b);
                double sum = 0.0;
                for (const Rgb& c : light.pixels()) sum += static_cast<double>(luminance(c)) / 256;
                return sum;
            };
            whole.add(mean(all[i]));
            parts.add(mean(gathered[i]) + mean(residual[i]));
            doubled.add(mean(gathered[i]) + 2.0 * mean(residual[i]));
            CHECK(mean(residual[i]) > 0.0);
        }
        CAPTURE(whole.mean(), parts.mean(), doubled.mean());
        CHECK(welch_p_value(whole, parts) > sidak(0.01, 3));
        // Little of the third bounce is residual: so few paths cannot tell.
        if (b < 3) CHECK(welch_p_value(whole, doubled) < sidak(0.01, 3));
    }
}

// H0: splats of light paths are the residual of luxels that the camera sees straight. Welch's test
// of the image's means of D_1 to D_3 over 24 replicates, seed 933, level 1 % over 3 comparisons.
TEST_CASE("light paths and camera paths bring the same caustics", "[statistical]") {
    const Studio<CookTorrance> studio(glass_corner());
    const mir::CameraRays rays = studio.rays(16, 933);
    const mir::LuxelTracer luxels{studio.engine.ray_caster(), studio.surfaces.view()};
    mir::PathTracerOptions options;
    options.paths = PathPart::residual;
    options.max_bounce = 3;
    options.directions = 64;
    const auto tracer = studio.tracer(options);
    const mir::CausticTracer caustics(studio.lights,
                                      mir::LightWalk<CookTorrance, mir::cpu::EmbreeRayCaster>{
                                          studio.surfaces.view(), studio.engine.ray_caster()},
                                      studio.engine.visibility(),
                                      {rays.camera.optics(), 1.0f, {16, 16}});
    mir::TbbExecutor executor;
    Moments splatted[4];
    Moments traced[4];
    for (std::uint64_t r = 0; r < 24; ++r) {
        double sums[4] = {};
        for (const auto& s :
             trace_caustics(caustics, {8192, 3, mir::Sequence::random, 933 + r}, 0, 8192, executor))
            sums[s.bounce] += static_cast<double>(luminance(s.radiance)) / 256;
        for (int b = 1; b <= 3; ++b) splatted[b].add(sums[b]);
        double back[4] = {};
        const mir::CameraRays moved{rays.camera, rays.grid, 933 + r};
        for (std::uint32_t i = 0; i < 4 * 256; ++i) {
            // Luxels of one pixel lie in its middle: places are drawn here.
            mir::Random random(933, mir::Stream::test, r * 1024 + i);
            const mir::Ray ray = moved.camera.ray(random.next_2d(), 1.0f, {0.5f, 0.5f});
            const mir::SeenLuxel seen = luxels(ray);
            if (seen.is_background || !seen.is_straight) continue;
            mir::RgbSum bounces[5] = {};
            tracer.trace({decltype(luxels)::hit(seen), luxels.surface(seen)}, random, bounces);
            for (int b = 1; b <= 3; ++b)
                back[b] += static_cast<double>(luminance(bounces[b].rgb())) / 1024;
        }
        for (int b = 1; b <= 3; ++b) traced[b].add(back[b]);
    }
    for (int b = 1; b <= 3; ++b) {
        CAPTURE(b, splatted[b].mean(), traced[b].mean());
        CHECK(splatted[b].mean() > 0.0);
        CHECK(welch_p_value(splatted[b], traced[b]) > sidak(0.01, 3));
    }
}
