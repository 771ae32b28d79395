// SPDX-License-Identifier: MIT
//
// Whole pictures by the GPU against the host's kd-tree, through the renderers that users call.
// tests/images/engines_test.cpp compares the kd-tree with Embree.
#include "images/support.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "support/catch.hpp"
#include "support/named_scene.hpp"
#include "support/statistics.hpp"

#include <algorithm>

namespace {

using mir::BackendKind;

mir::RenderResult render(const mir::Scene& scene, mir::RenderSettings settings, BackendKind backend,
                         const std::string& scheduler) {
    mir::Registry registry;
    mir::add_all_to(registry);
    settings.backend = backend;
    settings.scheduler = scheduler;
    return registry.make(backend, scheduler)->render(scene, settings, nullptr);
}

/// Calls check(name, scene) for each scene of picture_scenes() that this machine has.
template <class Check>
void for_each_picture_scene(const Check& check) {
    for (const mirtest::NamedScene& named : mirtest::picture_scenes()) {
        const auto scene = mirtest::load_scene(named.name, named.file);
        if (scene)
            check(named.name, *scene);
        else
            WARN("skipped: " << named.file << " is not on this machine");
    }
}

mir::RenderSettings settings_of(mir::SamplerKind sampler) {
    mir::RenderSettings s;
    s.image = {80, 60};
    s.luxels_per_pixel = 1;
    s.vpls = 64;
    s.sampler = sampler;
    s.acceleration = mir::Acceleration::kd_tree;
    s.tile = {48, 32};
    s.bounce_layers = true;
    s.allow_no_light = true;
    return s;
}

bool same_vpls(const mir::VplList& a, const mir::VplList& b) {
    return a.size() == b.size() && std::equal(a.vpls().begin(), a.vpls().end(), b.vpls().begin(),
                                              [](const mir::Vpl& x, const mir::Vpl& y) {
                                                  return x.position == y.position &&
                                                         x.normal == y.normal &&
                                                         x.intensity == y.intensity;
                                              });
}

void check_same(const mir::RenderResult& a, const mir::RenderResult& b) {
    CHECK(same_vpls(a.vpls, b.vpls));
    CHECK(a.statistics.path_luminance == b.statistics.path_luminance);
    CHECK(mirtest::same_bits(a.emission, b.emission));
    CHECK(mirtest::same_bits(a.direct, b.direct));
    CHECK(mirtest::same_bits(a.indirect, b.indirect));
    CHECK(mirtest::same_bits(a.beauty, b.beauty));
    CHECK(mirtest::same_bits(a.guides.albedo, b.guides.albedo));
    CHECK(std::ranges::equal(a.guides.depth.pixels(), b.guides.depth.pixels()));
    CHECK(a.statistics.indirect_luminance == b.statistics.indirect_luminance);
    REQUIRE(a.bounces.size() == b.bounces.size());
    for (std::size_t i = 0; i < a.bounces.size(); ++i)
        CHECK(mirtest::same_bits(a.bounces[i], b.bounces[i]));
}

}  // namespace

TEST_CASE("A GPU draws every scene with the bits of the host's kd-tree, by every scheduler") {
    const mir::SamplerKind sampler =
        GENERATE(mir::SamplerKind::metropolis, mir::SamplerKind::instant_radiosity);
    const mir::RenderSettings settings = settings_of(sampler);
    for_each_picture_scene([&](const std::string& name, const mir::Scene& scene) {
        const mir::RenderResult host = render(scene, settings, BackendKind::cpu, "cpu");
        for (const char* scheduler : {"os", "rc", "rcvp"}) {
            INFO(name << ", " << scheduler);
            check_same(host, render(scene, settings, BackendKind::cuda, scheduler));
        }
        for (const auto acceleration : {mir::Acceleration::automatic, mir::Acceleration::bvh}) {
            INFO(name << ", shafts, " << static_cast<int>(acceleration));
            mir::RenderSettings by_shafts = settings;
            by_shafts.acceleration = acceleration;
            check_same(host, render(scene, by_shafts, BackendKind::cuda, "rcvp"));
        }
    });
}

TEST_CASE("A GPU traces back what the bound removed with the bits of the host's kd-tree") {
    mir::RenderSettings settings = settings_of(mir::SamplerKind::instant_radiosity);
    settings.compensate = 2;
    for_each_picture_scene([&](const std::string& name, const mir::Scene& scene) {
        INFO(name);
        for (const auto sum : {mir::LightSum::all, mir::LightSum::cuts}) {
            settings.sum = sum;
            settings.bounce_layers = sum == mir::LightSum::all;
            const mir::RenderResult host = render(scene, settings, BackendKind::cpu, "cpu");
            check_same(host, render(scene, settings, BackendKind::cuda, "rcvp"));
        }
    });
}

TEST_CASE("A GPU refuses to trace by Embree, whatever makes the picture") {
    mir::RenderSettings s;
    s.image = {16, 16};
    s.luxels_per_pixel = 1;
    s.acceleration = mir::Acceleration::embree;
    const mir::Scene scene = mir::builtin::make("cornell-box");
    for (const auto integrator : {mir::Integrator::vpl, mir::Integrator::path}) {
        s.integrator = integrator;
        CHECK_THROWS_AS(render(scene, s, BackendKind::cuda, "rcvp"), mir::Error);
    }
}

// Hypothesis: the mean luminance of the indirect light is the same by GPU and by Embree, whose
// chains go other ways from the first ray on that one of them decides otherwise; seeds 0 to 15 and
// 100 to 115. Welch's test, 1 % over both scenes.
TEST_CASE("Metropolis sampling on the GPU brings the light that it brings with Embree",
          "[statistical]") {
    const double level = mirtest::sidak(0.01, 2);
    for_each_picture_scene([&](const std::string& name, const mir::Scene& scene) {
        if (name != "cornell-box.glb" && name != "veach-ajar-diffuse") return;
        INFO(name);
        mirtest::Moments by_gpu;
        mirtest::Moments by_embree;
        for (std::uint64_t seed = 0; seed < 16; ++seed) {
            mir::RenderSettings s = settings_of(mir::SamplerKind::metropolis);
            s.bounce_layers = false;
            s.seed = seed;
            by_gpu.add(
                mirtest::mean_luminance(render(scene, s, BackendKind::cuda, "rcvp").indirect));
            s.seed = seed + 100;
            s.acceleration = mir::Acceleration::embree;
            by_embree.add(
                mirtest::mean_luminance(render(scene, s, BackendKind::cpu, "cpu-blocks").indirect));
        }
        CHECK(mirtest::welch_p_value(by_gpu, by_embree) > level);
    });
}

TEST_CASE("All GPUs of a machine draw with the bytes of one") {
    mir::RenderSettings one =
        settings_of(GENERATE(mir::SamplerKind::metropolis, mir::SamplerKind::instant_radiosity));
    one.acceleration = mir::Acceleration::automatic;
    one.luxels_per_pixel = 4;
    one.removed_layer = true;
    one.filter = mir::default_filter(mir::FilterKind::mitchell);
    mir::RenderSettings all = one;
    all.devices.all = true;
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    const mir::RenderResult wanted = render(scene, one, BackendKind::cuda, "");
    const mir::RenderResult found = render(scene, all, BackendKind::cuda, "");
    check_same(found, wanted);
    CHECK(mirtest::same_bits(found.removed, wanted.removed));
    if (found.statistics.device.find(", ") == std::string::npos)
        WARN("this machine has one GPU: nothing was shared");
}
