// SPDX-License-Identifier: MIT
// Scenes in which samplers find little or nothing: each has a defined picture and says why.
#include "images/support.hpp"
#include "mir/scene/shapes.hpp"
#include "support/catch.hpp"

#include <algorithm>

using mir::RenderResult;
using mir::SamplerKind;
using mir::Scene;
using mirtest::render;

namespace {

/// The Cornell box without its lamp.
Scene unlit_box() {
    Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (mir::Material& m : scene.materials) m.emission = {};
    return scene;
}

/// A small closed box around a point.
void enclose(Scene& scene, mir::Vec3 centre) {
    const float side = 0.1f;
    scene.place(mir::builtin::box("cage", 0, centre - 0.5f * side, {side, 0, 0}, {0, side, 0},
                                  {0, 0, side}));
}

bool is_finite(const RenderResult& r) {
    const auto pixels = r.beauty.pixels();
    return std::all_of(pixels.begin(), pixels.end(),
                       [](const mir::Rgb& p) { return mir::is_finite(p); });
}

bool warns(const RenderResult& r, const std::string& words) {
    return std::any_of(r.warnings.begin(), r.warnings.end(),
                       [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

mir::RenderSettings settings_of(SamplerKind sampler) {
    auto s = mirtest::small_settings(16, 32);
    s.sampler = sampler;
    s.metropolis.bootstrap.max_paths = 1u << 15;
    return s;
}

}  // namespace

TEST_CASE("without a lamp every sampler refuses, or renders black when told to") {
    for (const SamplerKind sampler : mirtest::samplers) {
        auto settings = settings_of(sampler);
        CHECK_THROWS_AS(render(unlit_box(), settings), mir::Error);
        settings.allow_no_light = true;
        const RenderResult r = render(unlit_box(), settings);
        CHECK(mirtest::mean_luminance(r.beauty) == 0.0);
        CHECK(r.vpls.empty());
        CHECK(warns(r, "no light"));
    }
}

TEST_CASE("a lamp that nothing sees gives black, and chains say so") {
    for (const SamplerKind sampler : mirtest::samplers) {
        Scene scene = unlit_box();
        const auto lamp = scene.add(mir::emitter("hidden", {}, {1, 1, 1}));
        scene.place(
            mir::builtin::quad("hidden", lamp, {-0.01f, 5, 0.01f}, {0.02f, 0, 0}, {0, 0, -0.02f}));
        enclose(scene, {0, 5, 0});
        const RenderResult r = render(scene, settings_of(sampler));
        CHECK(mirtest::mean_luminance(r.beauty) == 0.0);
        if (sampler == SamplerKind::metropolis)
            CHECK(warns(r, "none of 32768 paths brought light"));
    }
}

TEST_CASE("a camera inside something solid sees black, and chains say so") {
    for (const SamplerKind sampler : mirtest::samplers) {
        Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
        enclose(scene, scene.cameras[0].position);
        const RenderResult r = render(scene, settings_of(sampler));
        CHECK(mirtest::mean_luminance(r.beauty) == 0.0);
        if (sampler == SamplerKind::metropolis) CHECK(warns(r, "inside something solid"));
    }
}

TEST_CASE("surfaces that reflect nothing give emission alone") {
    for (const SamplerKind sampler : mirtest::samplers) {
        Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
        for (mir::Material& m : scene.materials) m.base_color = {};
        const RenderResult r = render(scene, settings_of(sampler));
        CHECK(is_finite(r));
        CHECK(mirtest::mean_luminance(r.indirect) == 0.0);
        CHECK(mirtest::mean_luminance(r.direct) == 0.0);
    }
}

TEST_CASE("lights without extent alone light the room for every sampler") {
    for (const SamplerKind sampler : mirtest::samplers) {
        Scene scene = unlit_box();
        scene.point_lights.push_back({"bulb", {0, 1.5f, 0}, {1, 1, 1}, 0});
        const RenderResult r = render(scene, settings_of(sampler));
        CHECK(is_finite(r));
        CHECK(mirtest::mean_luminance(r.indirect) > 0.0);
        CHECK(mirtest::mean_luminance(r.direct) > 0.0);
    }
}

TEST_CASE("one VPL and many chains, or no indirect light at all, is no trouble") {
    const Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (const SamplerKind sampler : mirtest::samplers) {
        auto settings = settings_of(sampler);
        settings.vpls = 1;
        const RenderResult one = render(scene, settings);
        CHECK(is_finite(one));
        if (sampler != SamplerKind::instant_radiosity) CHECK(one.vpls.size() == 1);
        settings.max_bounce = 1;
        const RenderResult none = render(scene, settings);
        CHECK(none.vpls.empty());
        CHECK(mirtest::mean_luminance(none.indirect) == 0.0);
        CHECK(mirtest::mean_luminance(none.direct) > 0.0);
    }
}

TEST_CASE("settings that make no sense with a sampler are refused in words") {
    const Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    auto settings = settings_of(SamplerKind::metropolis);
    settings.normalisation = mir::NormalisationPolicy::none;
    CHECK_THROWS_WITH(render(scene, settings), Catch::Contains("normalise them"));
    settings = settings_of(SamplerKind::bidirectional);
    settings.max_bounce = 64;
    CHECK_THROWS_WITH(render(scene, settings), Catch::Contains("63 reflections"));
    settings = settings_of(SamplerKind::metropolis);
    settings.metropolis.stride = 0;
    CHECK_THROWS_WITH(render(scene, settings), Catch::Contains("stride"));
}

TEST_CASE("the reference integrator has the layers of a VPL render") {
    auto settings = settings_of(SamplerKind::metropolis);
    settings.integrator = mir::Integrator::path;
    settings.path.samples = 64;
    settings.bounce_layers = true;
    settings.max_bounce = 4;
    const Scene scene = mir::builtin::furnace_box();
    const RenderResult r = render(scene, settings);
    REQUIRE(r.bounces.size() == 4);
    CHECK(mirtest::mean_luminance(r.emission) == mirtest::Approx(0.5).epsilon(1e-5));
    CHECK(mirtest::mean_luminance(r.direct) == mirtest::Approx(0.25).epsilon(0.03));
    CHECK(mirtest::mean_luminance(r.bounces[0]) ==
          mirtest::Approx(mirtest::mean_luminance(r.direct)).epsilon(1e-5));
    const double later = mirtest::mean_luminance(r.bounces[1]) +
                         mirtest::mean_luminance(r.bounces[2]) +
                         mirtest::mean_luminance(r.bounces[3]);
    CHECK(mirtest::mean_luminance(r.indirect) == mirtest::Approx(later).epsilon(1e-5));
    CHECK(r.statistics.camera_paths == 16 * 16 * 64);
    CHECK(mir::is_finite(r.guides.normal(8, 8)));
}
