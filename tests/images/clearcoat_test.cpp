// SPDX-License-Identifier: MIT
//
// A coated ball under a white sky: the coat by chains, what lies below by samples of lights.
#include "images/support.hpp"
#include "mir/scene/shapes.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

using namespace mirtest;

namespace {

mir::Scene ball(float metallic, float coat, float coat_roughness = 0.0f) {
    mir::Scene scene;
    mir::Material m;
    m.name = "lacquer";
    m.base_color = {1.0f, 1.0f, 1.0f};
    m.metallic = metallic;
    m.specular = 0.0f;
    m.roughness = 1.0f;
    m.clearcoat = coat;
    m.clearcoat_roughness = coat_roughness;
    scene.place(mir::builtin::sphere("ball", scene.add(m), {0, 0, 0}, 1.0f, 48, 96));
    mir::Environment white;
    white.name = "white";
    white.radiance = mir::Image<mir::Rgb>({4, 2});
    for (mir::Rgb& texel : white.radiance.pixels()) texel = {1, 1, 1};
    scene.environment = white;
    scene.cameras.push_back(mir::Camera::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.4f));
    return scene;
}

/// Means of pictures of the ball alone, by seeds 0 to 15.
Moments means(const mir::Scene& scene, mir::RenderSettings s) {
    Moments all;
    for (s.seed = 0; s.seed < 16; ++s.seed) all.add(mean_luminance(render(scene, s).beauty));
    return all;
}

mir::RenderSettings settings_of(mir::Integrator integrator) {
    mir::RenderSettings s = small_settings(16, 64);
    s.integrator = integrator;
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.luxels_per_pixel = 4;
    s.direct_samples = 64;
    s.path.samples = 64;
    return s;
}

}  // namespace

// H0: the mean is 1. Student's t, level 1 % over both integrators; a coat that takes no light from
// what lies below would add 8 %.
TEST_CASE("a white ball below a clear coat vanishes under a white sky", "[statistical]") {
    const mir::Scene scene = ball(0.0f, 1.0f);
    for (const auto integrator : {mir::Integrator::path, mir::Integrator::vpl}) {
        const Moments m = means(scene, settings_of(integrator));
        CAPTURE(int(integrator), m.mean(), m.standard_error());
        CHECK(m.standard_error() < 4e-3);
        CHECK(mean_p_value(m, 1.0, 1e-4) > sidak(0.01, 2));
    }
}

// H0: both integrators have the same mean. Welch's test, level 1 % over a sharp and a rough coat;
// without its coat the ball is rejected.
TEST_CASE("a coated metal has the same light by VPLs and by paths", "[statistical]") {
    for (const float roughness : {0.0f, 0.4f}) {
        const mir::Scene coated = ball(1.0f, 1.0f, roughness);
        const Moments paths = means(coated, settings_of(mir::Integrator::path));
        const mir::RenderSettings s = settings_of(mir::Integrator::vpl);
        const Moments vpls = means(coated, s);
        CAPTURE(roughness, vpls.mean(), vpls.standard_error(), paths.mean());
        CHECK(welch_p_value(vpls, paths) > sidak(0.01, 2));
        CHECK(welch_p_value(means(ball(1.0f, 0.0f), s), paths) < sidak(0.01, 2));
    }
}
