// SPDX-License-Identifier: MIT
//
// Whole pictures under a sky by every integrator.
#include "images/support.hpp"
#include "support/catch.hpp"
#include "support/test_sky.hpp"

#include <algorithm>

using namespace mirtest;
using mir::Integrator;
using mir::RenderResult;
using mir::RenderSettings;
using mir::Rgb;

namespace {

/// A Cornell box without its lamp: what light there is comes through its open front.
mir::Scene open_box() {
    mir::Scene scene = mir::builtin::make("cornell-box");
    for (mir::Material& m : scene.materials) m.emission = {};
    scene.environment = test_sky();
    return scene;
}

RenderSettings settings_for(Integrator integrator) {
    RenderSettings s = small_settings(24, 1024);
    s.backend = mir::BackendKind::cpu;
    s.integrator = integrator;
    s.bounce_layers = true;
    s.max_bounce = 3;
    s.direct_samples = 256;
    s.path.samples = 512;
    s.micro.surfels = 4096;
    return s;
}

}  // namespace

// Noise and discs leave 2 % of direct and 8 % of indirect light; a sky that is turned, scaled or
// weighed otherwise is off by more than its own mean.
TEST_CASE("every integrator shows the same sky and its light") {
    mir::Scene scene = open_box();
    // Back, so that the sky is seen around the box.
    scene.cameras[0].position += 1.5f * scene.cameras[0].back;
    const RenderResult paths = render(scene, settings_for(Integrator::path));
    RenderSettings light_paths = settings_for(Integrator::vpl);
    light_paths.sampler = mir::SamplerKind::instant_radiosity;
    light_paths.vpls = 16384;
    const RenderResult vpls = render(scene, light_paths);
    const RenderResult discs = render(scene, settings_for(Integrator::micro));
    CHECK(mean_luminance(paths.emission) > 0.01);
    CHECK(mean_luminance(paths.indirect) > 0.01);
    for (const RenderResult* r : {&vpls, &discs}) {
        CHECK(same_bits(r->emission, vpls.emission));
        CHECK(relative_difference(r->emission, paths.emission) < 1e-5);
        CHECK(mean_luminance(r->direct) == Approx(mean_luminance(paths.direct)).epsilon(0.02));
        CHECK(mean_luminance(r->indirect) == Approx(mean_luminance(paths.indirect)).epsilon(0.08));
    }
    scene.environment->rotation += 90.0f;
    const RenderResult turned = render(scene, settings_for(Integrator::path));
    CHECK(relative_difference(turned.emission, paths.emission) > 0.1);
    CHECK(std::fabs(mean_luminance(turned.direct) / mean_luminance(paths.direct) - 1.0) > 0.1);
}

TEST_CASE("light is linear in the scale of the sky, bit by bit for powers of two") {
    mir::Scene scene = open_box();
    const RenderSettings s = settings_for(Integrator::vpl);
    const RenderResult once = render(scene, s);
    scene.environment->scale *= 4.0f;
    const RenderResult more = render(scene, s);
    for (std::size_t i = 0; i < once.direct.pixels().size(); ++i) {
        REQUIRE(more.direct.pixels()[i] == once.direct.pixels()[i] * 4.0f);
        REQUIRE(more.emission.pixels()[i] == once.emission.pixels()[i] * 4.0f);
    }
    CHECK(more.statistics.emitted_power == 4.0f * once.statistics.emitted_power);
}

TEST_CASE("a picture without any light is refused") {
    mir::Scene dark = open_box();
    dark.environment.reset();
    CHECK_THROWS_WITH(render(dark, settings_for(Integrator::vpl)), Catch::Contains("no light"));
}

// 2 % of direct light are left to the one set of directions that all luxels share; lamps that are
// counted twice, or a sky that is left out, change it by a tenth or more.
TEST_CASE("VPLs at infinity bring the direct light of a sky, those on lamps that of lamps") {
    mir::Scene scene = mir::builtin::make("cornell-box");
    scene.environment = test_sky();
    scene.environment->scale *= 4.0f;
    RenderSettings s = settings_for(Integrator::vpl);
    s.max_bounce = 1;
    s.vpls = 4096;
    const RenderResult sampled = render(scene, s);
    s.direct = mir::DirectLight::vpl;
    for (const mir::SamplerKind sampler : mirtest::samplers) {
        s.sampler = sampler;
        const RenderResult placed = render(scene, s);
        CHECK(mean_luminance(placed.direct) > 0.1 * mean_luminance(sampled.direct));
        CHECK(mean_luminance(placed.direct) + mean_luminance(placed.indirect) ==
              Approx(mean_luminance(sampled.direct)).epsilon(0.02));
    }
}

TEST_CASE("all luxels meet the same VPLs at infinity") {
    mir::Scene scene;
    const std::uint32_t white = scene.add(mir::lambertian("white", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::quad("floor", white, {-9, 0, -9}, {0, 0, 18}, {18, 0, 0}));
    scene.environment = test_sky(false);
    scene.cameras.push_back(mir::Camera::look_at({0, 2, 0}, {0, 0, 0}, {0, 0, -1}, 0.7f));
    RenderSettings s = settings_for(Integrator::vpl);
    s.vpls = 64;
    const auto differing = [&] {
        const RenderResult r = render(scene, s);
        const auto pixels = r.direct.pixels();
        CHECK(pixels[0].g > 0.0f);
        return std::count_if(pixels.begin(), pixels.end(), [&](Rgb value) {
            return std::fabs(value.g / pixels[0].g - 1) > 1e-4;
        });
    };
    CHECK(differing() > 0);
    s.direct = mir::DirectLight::vpl;
    CHECK(differing() == 0);
}
