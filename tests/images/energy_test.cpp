// SPDX-License-Identifier: MIT
//
// With full normalisation the mean luminance of the VPLs' light is P_c, less the share that was
// dropped, and each recorded state brings P_c / n of it. No test here is statistical: both hold for
// every seed and any number of VPLs.
#include "mir/io/gltf_reader.hpp"
#include "mir/runtime/check_scene.hpp"
#include "self_normalised.hpp"
#include "support.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"

using namespace mirtest;

namespace {

/// Settings of a small render by a few short chains.
mir::RenderSettings few_chains() {
    mir::RenderSettings s = small_settings(40, 96);
    s.image = {40, 30};
    s.sampler = mir::SamplerKind::metropolis;
    s.acceleration = mir::Acceleration::embree;  // the engine of Studio
    s.bound.kind = mir::BoundPolicy::Kind::automatic;
    s.direct_samples = 1;
    s.caustics = 0;  // the bootstrap does not know them
    s.max_bounce = 8;
    s.metropolis.chains = 12;  // fewer than VPLs, or nothing would mutate
    s.metropolis.stride = 8;
    s.metropolis.chain.tries = 4;
    s.metropolis.bootstrap = {1.0, 1u << 14, 1u << 14};
    return s;
}

/// |mean luminance - P_c (1 - dropped)| over P_c.
double imbalance(const mir::RenderResult& r, double luminance) {
    const mir::RenderStatistics& s = r.statistics;
    return std::abs(luminance - s.path_luminance * (1.0 - s.dropped_share)) / s.path_luminance;
}

double sum_of_bounces(const mir::RenderResult& r) {
    double sum = 0.0;
    for (const auto& bounce : r.bounces) sum += mean_luminance(bounce);
    return sum;
}

/// Checks one scene; false when none of its light is indirect.
bool balances(const mir::Scene& scene, mir::RenderSettings s) {
    s.bounce_layers = true;
    const mir::RenderResult r = render(scene, s);
    REQUIRE(r.statistics.health);
    if (!(r.statistics.path_luminance > 0.0)) {
        CHECK(r.statistics.indirect_luminance == 0.0);
        return false;
    }
    CHECK((r.statistics.health->mutations > 0) == (s.vpls > s.metropolis.chains));
    CAPTURE(r.statistics.path_luminance, r.statistics.dropped_share);
    CHECK(r.statistics.dropped_share < 1.0);
    CHECK(imbalance(r, r.statistics.indirect_luminance) < 1e-5);
    CHECK(imbalance(r, mean_luminance(r.indirect)) < 1e-5);
    CHECK(imbalance(r, sum_of_bounces(r)) < 1e-5);
    return true;
}

/// Luminance that each path VPL of a normalised render brings to the image, per recorded state.
template <mir::Bsdf B>
std::vector<double> flux_per_state(const Studio<B>& studio, const mir::RenderSettings& s,
                                   const mir::RenderResult& r) {
    const auto t = responses(studio, s, r.vpls, r.statistics.bound, studio.engine.visibility());
    std::vector<double> flux;
    for (const mir::PathVpl& p : r.vpls.path_vpls())
        if (!is_black(p.intensity))
            flux.push_back(image_luminance(t[p.vpl], p.intensity) / static_cast<double>(p.weight));
    return flux;
}

/// Standard deviation over mean.
double variation(const std::vector<double>& values) {
    Moments m;
    for (double v : values) m.add(v);
    return std::sqrt(m.variance()) / m.mean();
}

}  // namespace

TEST_CASE("the mean luminance is P_c in every built-in scene") {
    std::size_t lit = 0;
    for (const mir::builtin::Entry& entry : mir::builtin::scenes)
        for (const auto direct : {mir::DirectLight::separate, mir::DirectLight::vpl}) {
            mir::RenderSettings s = few_chains();
            s.direct = direct;
            CAPTURE(entry.name, int(direct));
            if (balances(entry.make(), s)) ++lit;
        }
    // All but the three of one lamp and one white surface have indirect light.
    CHECK(lit == 2 * mir::builtin::scenes.size() - 3);
}

TEST_CASE("the mean luminance is P_c whatever the number of VPLs, luxels and refreshes") {
    const mir::Scene scene = mir::builtin::make("cornell-inverted");
    mir::RenderSettings s = few_chains();
    s.vpls = GENERATE(1u, 7u, 300u);
    s.luxels_per_pixel = GENERATE(1u, 4u);
    s.metropolis.suffix_refresh = GENERATE(0u, 5u);
    s.seed = 3;
    CHECK(balances(scene, s));
}

TEST_CASE("the mean luminance is P_c in the shared scenes") {
    const auto scenes = shared_scenes();
    if (!scenes) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    for (const char* file :
         {"cornell-box/cornell-box.glb", "veach-ajar/veach-ajar-diffuse.gltf",
          "staircase/staircase.glb", "bmw-m6/bmw-m6.glb", "veach-mis/veach-mis.glb",
          "furnace/furnace-rho05.glb", "furnace/furnace-objects-rho05.glb"}) {
        const mir::Scene scene = mir::read_gltf(*scenes / file).scene;
        CAPTURE(file);
        CHECK(balances(scene, few_chains()));
    }
}

TEST_CASE("every recorded state brings the same luminance to the image") {
    for (const char* name : {"cornell-box", "cornell-inverted", "sphere-indirect", "door-ajar"}) {
        const Studio<mir::Lambert> studio(mir::builtin::make(name));
        const mir::RenderSettings s = few_chains();
        const mir::RenderResult r = render(studio.scene, s);
        const std::vector<double> flux = flux_per_state(studio, s, r);
        CAPTURE(name);
        REQUIRE(flux.size() > s.vpls);
        CHECK(variation(flux) < 1e-4);
        CHECK(flux.front() == Approx(r.statistics.path_luminance / s.vpls).epsilon(1e-4));
    }
}

TEST_CASE("the light groups add up to P_c") {
    mir::Scene scene = mir::builtin::make("sphere");
    scene.materials.back().light_group = 7;
    const Studio<mir::Lambert> studio(std::move(scene));
    const mir::RenderSettings s = few_chains();
    const mir::RenderResult r = render(studio.scene, s);
    const auto t = responses(studio, s, r.vpls, r.statistics.bound, studio.engine.visibility());
    double sum = 0.0;
    for (const std::uint16_t group : {std::uint16_t{0}, std::uint16_t{7}}) {
        const std::vector<mir::Vpl> lit = r.vpls.light_group(group);
        double light = 0.0;
        for (std::size_t v = 0; v < lit.size(); ++v)
            light += image_luminance(t[v], lit[v].intensity);
        CHECK(light > 0.05 * r.statistics.path_luminance);
        sum += light;
    }
    CHECK(imbalance(r, sum) < 1e-5);
}

namespace {

/// Render of chains whose responses somebody changed before normalisation.
template <class Change>
mir::RenderResult render_changed(const Studio<mir::Lambert>& studio, const mir::RenderSettings& s,
                                 const Change& change) {
    mir::TbbExecutor executor;
    const mir::VplRecords records = chains(studio, s, s.bound.value).sample(executor);
    mir::VplList list = aggregate(records);
    auto t = responses(studio, s, list, s.bound.value, studio.engine.visibility());
    for (mir::ImageResponse& v : t) change(v);
    const auto report = normalise(list, t, records.path_luminance, records.states);
    mir::RenderResult r = render(studio, s, relit(records, list));
    r.statistics.path_luminance = records.path_luminance;
    r.statistics.dropped_share = report.dropped_share;
    return r;
}

}  // namespace

TEST_CASE("wrong responses break the balance") {
    const Studio<mir::Lambert> studio(mir::builtin::make("cornell-box"));
    mir::RenderSettings s = few_chains();
    s.bound = {mir::BoundPolicy::Kind::fixed, 4.0f};
    const auto balance_of = [&](auto change) {
        const mir::RenderResult r = render_changed(studio, s, change);
        return imbalance(r, r.statistics.indirect_luminance);
    };
    CHECK(balance_of([](mir::ImageResponse&) {}) < 1e-5);
    // One number for all colours of light.
    CHECK(balance_of([](mir::ImageResponse& v) {
              v.r = v.g = v.b = image_luminance(v, {1, 1, 1});
          }) > 1e-5);
    // The mean is over the luxels that are lit.
    CHECK(balance_of([&](mir::ImageResponse& v) {
              const double share = static_cast<double>(v.lit_luxels) / (40.0 * 30.0);
              v = {v.r / share, v.g / share, v.b / share, v.lit_luxels};
          }) > 1e-5);
}

TEST_CASE("equal power is not equal flux") {
    const Studio<mir::Lambert> studio(mir::builtin::make("cornell-box"));
    mir::RenderSettings s = few_chains();
    s.sampler = mir::SamplerKind::instant_radiosity;
    CHECK(variation(flux_per_state(studio, s, render(studio.scene, s))) > 0.1);
}
