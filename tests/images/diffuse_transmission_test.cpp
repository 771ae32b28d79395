// SPDX-License-Identifier: MIT
//
// Light through leaves and paper, in pictures: how bright they are, and what they light.
#include "agreement_trial.hpp"
#include "images/support.hpp"
#include "mir/scene/shapes.hpp"
#include "support/bent_scene.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

using namespace mirtest;
using mir::Vec3;

namespace {

mir::Material paper(float reflectance, float through, mir::Rgb color) {
    mir::Material m = mir::lambertian("paper", {reflectance, reflectance, reflectance});
    m.diffuse_transmission = through;
    m.diffuse_transmission_color = color;
    return m;
}

/// A ball alone in the picture. Its faces are flat: interpolated normals lose light.
mir::Scene ball(const mir::Material& material) {
    mir::Scene scene;
    mir::Mesh mesh = mir::builtin::sphere("ball", scene.add(material), {0, 0, 0}, 1.0f, 48, 96);
    mesh.normals.clear();
    scene.place(std::move(mesh));
    scene.cameras.push_back(mir::Camera::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.4f));
    return scene;
}

mir::Scene under_white_sky(mir::Scene scene) {
    mir::Environment white;
    white.name = "white";
    white.radiance = mir::Image<mir::Rgb>({4, 2});
    for (mir::Rgb& texel : white.radiance.pixels()) texel = {1, 1, 1};
    scene.environment = white;
    return scene;
}

/// A leaf that fills the picture, seen from z > 0, lit from both sides with these irradiances.
mir::Scene lit_leaf(const mir::Material& material, float before, float behind) {
    mir::Scene scene;
    scene.place(mir::builtin::quad("leaf", scene.add(material), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
    scene.directional_lights = {{"before", {0, 0, -1}, {before, before, before}},
                                {"behind", {0, 0, 1}, {behind, behind, behind}}};
    scene.cameras.push_back(mir::Camera::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.3f));
    return scene;
}

/// A closed room that only the light through a round paper shade reaches, and a leaf.
mir::Scene lampshade_room(float through = 0.6f) {
    mir::Scene s;
    const std::uint32_t wall = s.add(mir::lambertian("wall", {0.7f, 0.6f, 0.5f}));
    s.place(mir::builtin::inside_out(
        mir::builtin::box("room", wall, {-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, {0, 0, 4})));
    const std::uint32_t shade = s.add(paper(0.4f, through, {0.8f, 0.6f, 0.3f}));
    s.place(mir::builtin::sphere("shade", shade, {0, 1.4f, 0}, 0.5f, 24, 12));
    s.place(mir::builtin::quad("leaf", shade, {0.7f, 0.1f, 0.4f}, {0.6f, 0, -0.5f}, {0, 0.8f, 0}));
    mir::Material bulb = mir::emitter("bulb", {0.5f, 0.5f, 0.5f}, {40, 40, 40});
    bulb.emits_from_both_sides = true;
    s.place(
        mir::builtin::quad("bulb", s.add(bulb), {-0.1f, 1.4f, 0.1f}, {0.2f, 0, 0}, {0, 0, -0.2f}));
    s.cameras = {mir::Camera::look_at({0.3f, 1.2f, 1.95f}, {0, 1.0f, 0}, {0, 1, 0}, 1.1f)};
    return s;
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

/// Means of pictures by seeds 0 to 15.
Moments means(const mir::Scene& scene, mir::RenderSettings s) {
    Moments all;
    for (s.seed = 0; s.seed < 16; ++s.seed) all.add(mean_luminance(render(scene, s).beauty));
    return all;
}

}  // namespace

// H0: the mean is 1. Student's t, level 1 % over both integrators, seeds 0 to 15. Light inside of
// the ball goes on until it comes out; without it a third of the light would be missing.
TEST_CASE("a ball of white leaf vanishes under a white sky", "[statistical]") {
    const mir::Scene scene = under_white_sky(ball(paper(1.0f, 0.4f, {1, 1, 1})));
    for (const auto integrator : {mir::Integrator::path, mir::Integrator::vpl}) {
        mir::RenderSettings s = settings_of(integrator);
        s.vpls = 4096;
        const Moments m = means(scene, s);
        CAPTURE(int(integrator), m.mean(), m.standard_error());
        CHECK(m.standard_error() < 1e-2);
        CHECK(mean_p_value(m, 1.0, 1e-4) > sidak(0.01, 2));
    }
}

// H0: the mean is E f c / pi. Student's t, level 1 % over two leaves and two integrators.
TEST_CASE("a leaf that is lit from behind has the brightness of its irradiance", "[statistical]") {
    const float irradiance = 3.0f;
    for (const float reflectance : {0.0f, 0.5f})
        for (const auto integrator : {mir::Integrator::path, mir::Integrator::vpl}) {
            const mir::Scene scene =
                lit_leaf(paper(reflectance, 0.7f, {0.5f, 0.5f, 0.5f}), 0.0f, irradiance);
            const Moments m = means(scene, settings_of(integrator));
            CAPTURE(reflectance, int(integrator), m.mean(), m.standard_error());
            const double expected = double{irradiance} * 0.7 * 0.5 / double{mir::pi};
            CHECK(mean_p_value(m, expected, 1e-5 * expected) > sidak(0.01, 4));
            CHECK(m.standard_error() < 0.01 * expected);
            // A black base leaves no other way than through: nothing is drawn.
            if (reflectance == 0.0f) CHECK(m.mean() == Approx(expected).epsilon(1e-5));
        }
}

// H0: the mean is that of what is reflected. Student's t, level 1 %.
TEST_CASE("a leaf that is lit from before reflects what does not go through", "[statistical]") {
    const mir::Scene scene = lit_leaf(paper(0.8f, 0.25f, {1, 1, 1}), 2.0f, 0.0f);
    const Moments m = means(scene, settings_of(mir::Integrator::vpl));
    CHECK(mean_p_value(m, 2.0 * 0.75 * 0.8 / double{mir::pi}, 1e-5) > 0.01);
    CHECK(m.standard_error() < 0.01);
}

// H0: equal means, by bounces and tiles as in agreement_test.cpp: Welch's test over 16 replicates,
// level 1 % over 3 samplers, seeds 0 to 15, path tracer 811. All light behind the first bounce has
// gone through the shade.
TEST_CASE("IR, BIR and MIR bring the light of the path tracer through a paper lampshade",
          "[statistical]") {
    const double level = sidak(0.01, 3);
    const Trial trial(lampshade_room(), 64);
    CHECK(trial.p_of(instant_radiosity(trial.settings, 2048)) > level);
    CHECK(trial.p_of(metropolis(trial.settings)) > level);
    const BounceMeans resampled = trial.rendered(bidirectional(trial.settings));
    CHECK(agreement(resampled, trial.truth) > level);
    // Paper that lets a little less through is not taken for it.
    CHECK(agreement(resampled, Trial(lampshade_room(0.5f), 64).truth) < level);
}
