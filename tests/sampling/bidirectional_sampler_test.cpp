// SPDX-License-Identifier: MIT
#include "mir/sampling/bidirectional_sampler.hpp"

#include "conformance/sampler_suite.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/analytic_sphere.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/sampler_light.hpp"
#include "support/wedge.hpp"

namespace {

using mir::BidirectionalOptions;
using mir::BidirectionalSampler;
using mir::CookTorrance;
using mir::Lambert;
using mir::VplRecords;
using mirtest::instant_radiosity;
using mirtest::PathLab;
using mirtest::probe_of;
using mirtest::ProbeOf;
using mirtest::SamplerLight;

constexpr std::uint32_t vpls = 128;

BidirectionalOptions small_options(std::uint64_t seed) {
    BidirectionalOptions o;
    o.vpls = vpls;
    o.candidates = 4;
    o.emitter_vpls = true;
    o.seed = seed;
    return o;
}

/// Seeds from `seed` on.
template <class Rules, mir::Bsdf B>
SamplerLight resampled(const PathLab<B>& lab, const ProbeOf<B>& probe, std::uint64_t seed,
                       mir::TargetFloor floor = {}) {
    using World = typename PathLab<B>::World;
    mir::TbbExecutor threads(2);
    return light_of_seeds(lab, seed, [&](std::uint64_t s) {
        BidirectionalOptions o = small_options(s);
        o.floor = floor;
        return BidirectionalSampler<World, Rules>(lab.world(), probe, o).sample(threads);
    });
}

struct GeneratingTechniqueAlone : mir::ResamplingRules {
    static double mixture(const mir::PathMeasure& m, mir::Technique t,
                          const mir::TechniqueTable& table, double from_probe) {
        const bool light_path = t.from_light + 1 == t.edges;
        if (light_path) return mir::ResamplingRules::mixture(m, t, table, 0.0);
        return from_probe * table.probability(t.edges) * table.probability_of(t) *
               technique_density(m, t.edges, t.from_light, 3);
    }
};
/// As if the VPLs were all candidates there are.
struct SumOverVpls : mir::ResamplingRules {
    static double mean(std::span<const double> w) {
        return mir::ResamplingRules::mean(w) * static_cast<double>(w.size()) / vpls;
    }
};
/// Candidates without light are not counted.
struct SelfNormalised : mir::ResamplingRules {
    static double mean(std::span<const double> w) {
        const auto lit = std::count_if(w.begin(), w.end(), [](double x) { return x > 0.0; });
        return mir::ResamplingRules::mean(w) * static_cast<double>(w.size()) /
               static_cast<double>(lit);
    }
};

}  // namespace

// H0: resampled VPLs bring every bounce and every sixteenth of the image the light that instant
// radiosity brings. Welch's test over 32 replicates each, 1 % per case after Sidak; seeds from 1000
// on.
TEST_CASE("resampled VPLs bring the light of instant radiosity", "[statistical]") {
    const auto* name = GENERATE("cornell-box", "cornell-inverted");
    const PathLab<Lambert> lab(mir::builtin::make(name));
    CAPTURE(name);
    const SamplerLight light = resampled<mir::ResamplingRules>(lab, probe_of(lab), 1000);
    CHECK(agreement(light, instant_radiosity(lab), 1) > 0.01);
}

TEST_CASE("resampled VPLs bring the light of instant radiosity from glossy surfaces",
          "[statistical]") {
    const PathLab<CookTorrance> lab(mirtest::Wedge(mirtest::WedgeLights::two_sided, 1.0f).scene());
    const SamplerLight light = resampled<mir::ResamplingRules>(lab, probe_of(lab), 1100);
    CHECK(agreement(light, instant_radiosity(lab), 1) > 0.01);
}

TEMPLATE_TEST_CASE("resampling by a wrong rule is rejected", "[statistical]",
                   GeneratingTechniqueAlone, SumOverVpls, SelfNormalised) {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    const SamplerLight light = resampled<TestType>(lab, probe_of(lab), 1200);
    CHECK(agreement(light, instant_radiosity(lab), 1) < 1e-4);
}

// The probe's four luxels leave much of the box unseen. Seeds from 1300 on.
TEST_CASE("the floor keeps the light that the probe does not see", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    const auto probe = probe_of(lab, 1);
    const SamplerLight judge = instant_radiosity(lab);
    const SamplerLight right = resampled<mir::ResamplingRules>(lab, probe, 1300, {.share = 0.5f});
    CHECK(agreement(right, judge, 1) > 0.01);
    const SamplerLight wrong = resampled<mir::ResamplingRules>(lab, probe, 1300, {.share = 1e-9f});
    CHECK(agreement(wrong, judge, 1) < 1e-4);
}

// H0: see check_furnace(); seeds from 1400 on. Paths that run into lamps, which are rarely drawn,
// find most light where every wall is one: the later bounces are noisy.
TEST_CASE("in the furnace resampled VPLs bring every bounce its light", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    mirtest::check_furnace(resampled<mir::ResamplingRules>(lab, probe_of(lab), 1400), 0.1);
}

// Bulb of 3 W sr^-1 in the centre of a sphere whose halves reflect 0.8 and 0.2: bounce b sends out
// power times 0.5^(b-1). H0: pi times the sum of J is that. Student's t over 256 seeds from 1500
// on, 1 % over 4 bounces.
TEST_CASE("inside a sphere resampled VPLs send out what it reflects", "[statistical]") {
    mir::Scene scene;
    const std::uint32_t upper = scene.add(mir::lambertian("upper", {0.8f, 0.8f, 0.8f}));
    const std::uint32_t lower = scene.add(mir::lambertian("lower", {0.2f, 0.2f, 0.2f}));
    scene.place(mir::builtin::box("box", upper, mir::Vec3(-2), {4, 0, 0}, {0, 4, 0}, {0, 0, 4}));
    scene.point_lights.push_back({"bulb", {0, 0, 0}, {3, 3, 3}});
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::SurfaceTable<Lambert> surfaces(scene);
    using World = mir::PathWorld<Lambert, mirtest::AnalyticSphere, mirtest::FreeSight>;
    const auto camera = mir::Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.2f);
    const World world{geometry, lights, surfaces, {2.0f, upper, lower}, {}, camera};
    using Sampler = BidirectionalSampler<World>;
    const Sampler::Probe probe({camera, 1.0f, 64, 5}, world.luxels.caster, surfaces,
                               world.visibility);
    std::array<mirtest::Moments, 6> sent;
    mir::InlineExecutor one;
    for (std::uint64_t seed = 1500; seed < 1756; ++seed) {
        std::array<double, 6> sums{};
        for (const mir::VplRecord& r :
             Sampler(world, probe, small_options(seed)).sample(one).records)
            if (r.bounce <= 5)
                sums[r.bounce] += mirtest::pi * static_cast<double>(r.vpl.intensity.g);
        for (std::size_t b = 2; b <= 5; ++b) sent[b].add(sums[b]);
    }
    for (std::size_t b = 2; b <= 5; ++b) {
        const double power = 4.0 * mirtest::pi * 3.0 * std::pow(0.5, b - 1);
        CAPTURE(b, sent[b].mean(), power);
        CHECK(mirtest::mean_p_value(sent[b], power) > mirtest::sidak(0.01, 4));
        CHECK(mirtest::mean_p_value(sent[b], 1.1 * power) < 1e-3);
    }
}

TEMPLATE_TEST_CASE("BidirectionalSampler is a Sampler whose records are the same on any executor",
                   "", Lambert, CookTorrance) {
    const PathLab<TestType> lab(mir::builtin::make("sphere-indirect"));
    const auto probe = probe_of(lab);
    const auto make = [&](std::uint64_t seed) {
        return BidirectionalSampler<typename PathLab<TestType>::World>(lab.world(), probe,
                                                                       small_options(seed));
    };
    mir::TbbExecutor threads(4);
    mirtest::sampler_suite(make, threads);
}

TEST_CASE("a resampled set stands for as many VPLs as were asked for, each of about equal flux") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-inverted"));
    const auto probe = probe_of(lab);
    mir::InlineExecutor one;
    const VplRecords set =
        BidirectionalSampler<PathLab<Lambert>::World>(lab.world(), probe, small_options(1))
            .sample(one);
    CHECK(set.paths == vpls * 4);
    float drawn = 0.0f;
    mirtest::Moments flux;
    for (const mir::VplRecord& r : set.records) {
        drawn += r.weight;
        flux.add(static_cast<double>(probe.flux(r.vpl, r.vpl.intensity) / r.weight));
    }
    CHECK(drawn == static_cast<float>(vpls));
    CHECK(flux.variance() < 0.1 * flux.mean() * flux.mean());
}

TEST_CASE("where there is no light, resampling yields no VPL") {
    const bool black = GENERATE(true, false);
    const PathLab<Lambert> lab(mirtest::dark_box(black));
    const auto probe = probe_of(lab);
    BidirectionalOptions o = small_options(1);
    o.emitter_vpls = false;
    mir::InlineExecutor one;
    const VplRecords set =
        BidirectionalSampler<PathLab<Lambert>::World>(lab.world(), probe, o).sample(one);
    CHECK(set.records.empty());
    CHECK((set.emitted_power > 0.0f) == black);
}

TEST_CASE("options that make no sense are refused") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    const auto probe = probe_of(lab);
    const auto refused = [&](auto change) {
        BidirectionalOptions o;
        change(o);
        using Sampler = BidirectionalSampler<PathLab<Lambert>::World>;
        CHECK_THROWS_AS(Sampler(lab.world(), probe, o, {.vpls = 10'000}), mir::Error);
    };
    refused([](BidirectionalOptions& o) { o.vpls = 0; });
    refused([](BidirectionalOptions& o) { o.vpls = 10'001; });
    refused([](BidirectionalOptions& o) { o.candidates = 0; });
    refused([](BidirectionalOptions& o) { o.vpls = 10'000, o.candidates = 1u << 15; });
    refused([](BidirectionalOptions& o) { o.floor.share = 0.0f; });
    refused([](BidirectionalOptions& o) { o.floor.pilot_paths = 0; });
    refused([](BidirectionalOptions& o) { o.max_bounce = 1; });
    refused([](BidirectionalOptions& o) { o.max_bounce = 64; });
}
