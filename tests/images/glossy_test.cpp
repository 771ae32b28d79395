// SPDX-License-Identifier: MIT
//
// Pictures by VPLs that keep the lobes of their surfaces: the light of the path tracer on surfaces
// of any roughness that is not widened, the same bits however the work is cut.
#include "bounce_means.hpp"
#include "however_cut.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SamplerKind;

namespace {

constexpr std::uint32_t runs = 16;

mir::Scene metal_corner(float roughness) {
    mir::Scene scene = mir::builtin::make("corner");
    for (mir::Material& m : scene.materials) {
        if (m.emits()) continue;
        m.metallic = 1.0f;
        m.roughness = roughness;
    }
    return scene;
}

mir::RenderSettings lobes(float least_roughness) {
    mir::RenderSettings s = small_settings(24, 512);
    s.sampler = SamplerKind::instant_radiosity;
    s.direct_samples = 1;
    s.max_bounce = BounceMeans::last_bounce;
    s.glossy = {true, least_roughness};
    return s;
}

BounceMeans rendered(const mir::Scene& scene, mir::RenderSettings s, std::uint64_t first_seed) {
    BounceMeans means;
    s.bounce_layers = true;
    for (s.seed = first_seed; s.seed < first_seed + runs; ++s.seed) means.add(render(scene, s));
    return means;
}

BounceMeans traced(const mir::Scene& scene) {
    mir::RenderSettings s = lobes(0.5f);
    s.glossy.enabled = false;
    s.sampler = SamplerKind::metropolis;
    s.bound = {};
    s.integrator = mir::Integrator::path;
    s.path.samples = 256;
    return rendered(scene, s, 911);
}

}  // namespace

// H0: equal means of D_2 .. D_5 and of their sum, in 9 tiles and over the image. Welch's test over
// 16 replicates each, seeds 0 to 15 and 911 to 926, level 1 %; without lobes, and with lobes that
// are too wide, it is rejected.
TEST_CASE("VPLs that keep their lobes bring the light of the path tracer", "[statistical]") {
    const mir::Scene scene = metal_corner(0.6f);
    const BounceMeans truth = traced(scene);
    mir::RenderSettings s = lobes(0.5f);
    CHECK(agreement(rendered(scene, s, 0), truth) > 0.01);
    CHECK(agreement(rendered(scene, lobes(1.0f), 0), truth) < 0.01);
    s.glossy.enabled = false;
    CHECK(agreement(rendered(scene, s, 0), truth) < 0.01);
}

// What is traced back is what the bound removed, of VPLs with lobes too. As above, level 1 %;
// rejected without it.
TEST_CASE("bounded VPLs with lobes and what is traced back bring the light of the path tracer",
          "[statistical]") {
    const mir::Scene scene = metal_corner(0.6f);
    const BounceMeans truth = traced(scene);
    mir::RenderSettings s = lobes(0.5f);
    s.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
    CHECK(agreement(rendered(scene, s, 0), truth) < 0.01);
    s.compensate = 8;
    CHECK(agreement(rendered(scene, s, 0), truth) > 0.01);
}

TEST_CASE("threads, tiles, scheduler and stored visibility change no bit of the light of lobes") {
    check_light_however_cut(metal_corner(0.6f), lobes(0.5f));
}

TEST_CASE("VPLs of Lambertian surfaces light the same with and without lobes") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings s = lobes(0.5f);
    s.direct = GENERATE(mir::DirectLight::separate, mir::DirectLight::vpl);
    const mir::RenderResult with = render(scene, s);
    s.glossy.enabled = false;
    const mir::RenderResult without = render(scene, s);
    CHECK(with.vpls.size() == without.vpls.size());
    CHECK(relative_difference(with.beauty, without.beauty) < 1e-5);
}

TEST_CASE("lobes add up by bounces, and what was widened and removed is told") {
    const mir::Scene scene = metal_corner(0.6f);
    mir::RenderSettings s = lobes(0.5f);
    s.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
    s.bounce_layers = true;
    const mir::RenderResult r = render(scene, s);
    double bounces = 0.0;
    for (const auto& layer : r.bounces) bounces += mean_luminance(layer);
    CHECK(mean_luminance(r.indirect) == Approx(bounces).epsilon(1e-6));
    CHECK(r.statistics.non_lambertian_share == 0.0f);
    CHECK(r.statistics.widened_share == 0.0f);
    CHECK(r.statistics.removed_luminance > 0.0);
    s.bound.kind = mir::BoundPolicy::Kind::none;
    const mir::RenderResult all = render(scene, s);
    CHECK(mean_luminance(all.indirect) - mean_luminance(r.indirect) ==
          Approx(r.statistics.removed_luminance).epsilon(1e-4));
    s.glossy.least_roughness = 0.7f;
    CHECK(render(scene, s).statistics.widened_share == Approx(1.0f));
}

TEST_CASE("settings that do not go with lobes are refused") {
    const auto refused = [](auto change) {
        mir::RenderSettings s;
        s.sampler = SamplerKind::instant_radiosity;
        s.glossy.enabled = true;
        CHECK_NOTHROW(s.validate());
        change(s);
        CHECK_THROWS_AS(s.validate(), mir::Error);
        s.glossy.enabled = false;
        CHECK_NOTHROW(s.validate());
    };
    refused([](mir::RenderSettings& s) { s.glossy.least_roughness = -0.1f; });
    refused([](mir::RenderSettings& s) { s.glossy.least_roughness = 1.5f; });
    refused([](mir::RenderSettings& s) { s.integrator = mir::Integrator::path; });
    refused([](mir::RenderSettings& s) { s.sampler = SamplerKind::metropolis; });
    refused([](mir::RenderSettings& s) { s.sampler = SamplerKind::bidirectional; });
    refused([](mir::RenderSettings& s) { s.vpl_roulette = true; });
    refused([](mir::RenderSettings& s) { s.vsl.enabled = true; });
}
