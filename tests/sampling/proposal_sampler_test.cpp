// SPDX-License-Identifier: MIT
#include "mir/sampling/proposal_sampler.hpp"

#include "conformance/sampler_suite.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/sampler_light.hpp"
#include "support/wedge.hpp"

namespace {

using mir::CookTorrance;
using mir::Lambert;
using mir::MetropolisOptions;
using mir::ProposalSampler;
using mir::TargetFloor;
using mir::VplRecords;
using mirtest::instant_radiosity;
using mirtest::PathLab;
using mirtest::probe_of;
using mirtest::ProbeOf;
using mirtest::SamplerLight;

MetropolisOptions small_options(std::uint64_t seed) {
    MetropolisOptions o;
    o.states = 128;
    o.stride = 4;
    o.chains = 8;
    o.suffix_refresh = 2;
    o.bootstrap = {0.05, 2048, 2048};
    o.emitter_vpls = true;
    o.seed = seed;
    return o;
}

/// Seeds from `seed` on; `change` may spoil the records.
template <mir::Bsdf B, class Change>
SamplerLight light_of(const PathLab<B>& lab, const ProbeOf<B>& probe, std::uint64_t seed,
                      TargetFloor floor, const Change& change) {
    mir::TbbExecutor threads(2);
    return light_of_seeds(lab, seed, [&](std::uint64_t s) {
        VplRecords records =
            ProposalSampler(lab.world(), probe, small_options(s), floor).sample(threads);
        change(records);
        return records;
    });
}
template <mir::Bsdf B>
SamplerLight light_of(const PathLab<B>& lab, std::uint64_t seed) {
    return light_of(lab, probe_of(lab), seed, {}, [](VplRecords&) {});
}

}  // namespace

// H0: chains over light paths bring every bounce and every sixteenth of the image the light that
// instant radiosity brings. Welch's test over 32 replicates each, 1 % per case after Sidak; seeds
// in the cases.

TEST_CASE("chains over light paths bring the light of instant radiosity", "[statistical]") {
    const auto* name = GENERATE("cornell-box", "cornell-inverted");
    const PathLab<Lambert> lab(mir::builtin::make(name));
    CAPTURE(name);
    CHECK(agreement(light_of(lab, 2000), instant_radiosity(lab), 1) > 0.01);
}

TEST_CASE("chains over light paths bring the light of instant radiosity from glossy surfaces",
          "[statistical]") {
    const PathLab<CookTorrance> lab(mirtest::Wedge(mirtest::WedgeLights::two_sided, 1.0f).scene());
    CHECK(agreement(light_of(lab, 2100), instant_radiosity(lab), 1) > 0.01);
}

TEST_CASE("chains over light paths with wrong weights are rejected", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    const SamplerLight judge = instant_radiosity(lab);
    const auto p_of = [&](const auto& change) {
        return agreement(light_of(lab, probe_of(lab), 2200, {}, change), judge, 1);
    };
    SECTION("rejected proposals counted once") {
        CHECK(p_of([](VplRecords& r) {
                  const auto same = [](const mir::VplRecord& a, const mir::VplRecord& b) {
                      return is_same_vpl(a, b) && a.vpl.intensity.g == b.vpl.intensity.g;
                  };
                  r.records.erase(std::unique(r.records.begin(), r.records.end(), same),
                                  r.records.end());
              }) < 1e-4);
    }
    SECTION("equal luminous intensity") {
        CHECK(p_of([](VplRecords& r) {
                  double sum = 0.0;
                  for (const mir::VplRecord& v : r.records)
                      sum += static_cast<double>(luminance(v.vpl.intensity));
                  const double mean = sum / static_cast<double>(r.records.size());
                  for (mir::VplRecord& v : r.records)
                      v.vpl.intensity = v.vpl.intensity *
                                        static_cast<float>(
                                            mean / static_cast<double>(luminance(v.vpl.intensity)));
              }) < 1e-4);
    }
}

TEST_CASE("the floor keeps light that the probe of a chain does not see", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    const auto probe = probe_of(lab, 1);
    const SamplerLight judge = instant_radiosity(lab);
    const auto keep = [](VplRecords&) {};
    CHECK(agreement(light_of(lab, probe, 2300, {.share = 0.5f}, keep), judge, 1) > 0.01);
    CHECK(agreement(light_of(lab, probe, 2300, {.share = 1e-9f}, keep), judge, 1) < 1e-4);
}

// H0: see check_furnace(); seeds from 2400 on.
TEST_CASE("in the furnace chains over light paths bring every bounce its light", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    mirtest::check_furnace(light_of(lab, 2400), 0.1);
}

// H0, level and seeds: see mir::validation::check_sampler_light().
TEST_CASE("chains over light paths bring a known furnace its light", "[statistical]") {
    const mir::validation::KnownLight room = mir::validation::known_furnace();
    const PathLab<Lambert> lab(room.scene());
    const auto probe = probe_of(lab);
    mirtest::passes(mir::validation::check_sampler(
        [&](std::uint64_t seed) {
            return ProposalSampler(lab.world(), probe, small_options(seed));
        },
        room, {1, 32}));
}

TEMPLATE_TEST_CASE("ProposalSampler is a Sampler whose records are the same on any executor", "",
                   Lambert, CookTorrance) {
    const PathLab<TestType> lab(mir::builtin::make("sphere-indirect"));
    const auto probe = probe_of(lab);
    const auto make = [&](std::uint64_t seed) {
        return ProposalSampler(lab.world(), probe, small_options(seed));
    };
    mir::TbbExecutor threads(4);
    mirtest::sampler_suite(make, threads);
}

TEST_CASE("the states of chains over light paths give the probe about equal flux") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-inverted"));
    const auto probe = probe_of(lab);
    mir::InlineExecutor one;
    const VplRecords set = ProposalSampler(lab.world(), probe, small_options(1)).sample(one);
    mirtest::Moments flux;
    double states = 0.0;
    for (const mir::VplRecord& r : set.records) {
        states += static_cast<double>(r.weight);
        flux.add(static_cast<double>(probe.flux(r.vpl, r.vpl.intensity) / r.weight));
    }
    CHECK(states == mirtest::Approx(128.0));
    CHECK(set.states == 128.0);
    CHECK(flux.variance() < 0.1 * flux.mean() * flux.mean());
}

TEST_CASE("where there is no light, chains over light paths yield no VPL") {
    const PathLab<Lambert> lab(mirtest::dark_box(GENERATE(true, false)));
    const auto probe = probe_of(lab);
    MetropolisOptions o = small_options(1);
    o.emitter_vpls = false;
    mir::InlineExecutor one;
    const VplRecords set = ProposalSampler(lab.world(), probe, o).sample(one);
    CHECK(set.records.empty());
    CHECK(set.health->luminance.mean == 0.0);
}

TEST_CASE("chains over light paths refuse options that make no sense") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    const auto probe = probe_of(lab);
    const auto refused = [&](auto change) {
        MetropolisOptions o;
        TargetFloor floor;
        change(o, floor);
        CHECK_THROWS_AS(ProposalSampler(lab.world(), probe, o, floor, {.vpls = 1000}), mir::Error);
    };
    refused([](MetropolisOptions& o, TargetFloor&) { o.states = 0; });
    refused([](MetropolisOptions& o, TargetFloor&) { o.states = 1001; });
    refused([](MetropolisOptions& o, TargetFloor&) { o.stride = 0; });
    refused([](MetropolisOptions& o, TargetFloor&) {
        o.chain.mutation = mir::Mutation::bidirectional;
    });
    refused([](MetropolisOptions& o, TargetFloor&) { o.max_bounce = 1; });
    refused([](MetropolisOptions&, TargetFloor& f) { f.share = 0.0f; });
    refused([](MetropolisOptions&, TargetFloor& f) { f.pilot_paths = 0; });
}
