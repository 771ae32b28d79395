// SPDX-License-Identifier: MIT
//
// Pictures whose luxels gather a few of many VPLs: the light of the path tracer, less noise than
// as many VPLs for all luxels, the same bits however the work is cut.
#include "bounce_means.hpp"
#include "however_cut.hpp"
#include "mir/cuts/vpl_tree.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SamplerKind;

namespace {

constexpr std::uint32_t runs = 64;

mir::RenderSettings cuts(std::uint32_t vpls, std::uint32_t picks) {
    mir::RenderSettings s = small_settings(24, vpls);
    s.sampler = SamplerKind::instant_radiosity;
    s.direct_samples = 1;
    s.max_bounce = BounceMeans::last_bounce;
    s.sum = mir::LightSum::cuts;
    s.picks = picks;
    return s;
}

BounceMeans rendered(const mir::Scene& scene, mir::RenderSettings s, std::uint64_t first_seed) {
    BounceMeans means;
    s.bounce_layers = true;
    for (s.seed = first_seed; s.seed < first_seed + runs; ++s.seed) means.add(render(scene, s));
    return means;
}

/// Root of the mean square difference of indirect luminance, over its mean.
double deviation(const mir::RenderResult& r, const mir::RenderResult& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.indirect.pixels().size(); ++i) {
        const double d = static_cast<double>(luminance(r.indirect.pixels()[i])) -
                         static_cast<double>(luminance(truth.indirect.pixels()[i]));
        sum += d * d;
    }
    return std::sqrt(sum / static_cast<double>(truth.indirect.pixels().size())) /
           mean_luminance(truth.indirect);
}

}  // namespace

// H0: equal means of D_2 .. D_5 and of their sum, in 9 tiles and over the image. Welch's test over
// 64 replicates each, seeds 0 to 63 and 911 to 974, level 1 % for each sampler. Without a bound few
// of few picks bring most of the light: means of 32 picks are not normal over 64 replicates. With a
// bound they are (tests/cuts/reconstruct_cuts_test.cpp).
TEST_CASE("cuts of many VPLs bring the light of the path tracer", "[statistical]") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings paths = cuts(1, 1);
    paths.sum = mir::LightSum::all;
    paths.integrator = mir::Integrator::path;
    paths.path.samples = 256;
    const BounceMeans truth = rendered(scene, paths, 911);
    mir::RenderSettings s = cuts(2048, 128);
    for (const SamplerKind sampler : {SamplerKind::instant_radiosity, SamplerKind::metropolis}) {
        s.sampler = sampler;
        CAPTURE(static_cast<int>(sampler));
        CHECK(agreement(rendered(scene, s, 0), truth) > 0.01);
    }
}

TEST_CASE("a cut of many VPLs is nearer to all of them than as many VPLs for all luxels") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = cuts(4096, 64);
    const mir::RenderResult picked = render(scene, s);
    s.sum = mir::LightSum::all;
    const mir::RenderResult all = render(scene, s);
    s.vpls = 64;
    CHECK(deviation(picked, all) < 0.5 * deviation(render(scene, s), all));
}

TEST_CASE("threads, tiles, scheduler and room for visibility change no bit of the light of cuts") {
    mir::RenderSettings s = cuts(64, 16);
    for (const SamplerKind sampler : {SamplerKind::instant_radiosity, SamplerKind::metropolis}) {
        s.sampler = sampler;
        check_light_however_cut(mir::builtin::make("cornell-box"), s);
    }
}

TEST_CASE("cuts are chosen for many VPLs, where nothing needs all of them") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    const auto picks_of = [&](mir::RenderSettings s) {
        s.sum = mir::LightSum::automatic;
        const mir::RenderStatistics found = render(scene, s).statistics;
        return found.contributions / found.luxels;
    };
    mir::RenderSettings s = cuts(mir::most_vpls_summed, 4);
    s.image = {4, 4};
    CHECK(picks_of(s) > 4);
    ++s.vpls;
    CHECK(picks_of(s) == 4);
    s.removed_layer = true;
    CHECK(picks_of(s) > 4);
}

TEST_CASE("the chosen sum has the bits of the one that it is") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = cuts(mir::most_vpls_summed + 1, 4);
    const mir::RenderResult wanted = render(scene, s);
    s.sum = mir::LightSum::automatic;
    CHECK(mirtest::same_bits(render(scene, s).beauty, wanted.beauty));
}

TEST_CASE("cuts say what they did") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = cuts(500, 20);
    s.sampler = SamplerKind::metropolis;
    mir::Monitor monitor;
    const mir::RenderResult r = render(scene, s, &monitor);
    CHECK(r.statistics.normalisation == "proposal");
    CHECK(r.statistics.vpls > 100);
    CHECK(r.statistics.contributions == r.statistics.luxels * 20);
    CHECK(r.statistics.removed_luminance == 0.0);
    CHECK(monitor.planned_contributions == r.statistics.contributions);
    CHECK(monitor.contributions <= monitor.planned_contributions);
    CHECK(monitor.contributions > 0);
}

TEST_CASE("a tree that memory has no room for is refused before it is made") {
    mir::RenderSettings s = cuts(500, 20);
    s.limits.vpl_tree_bytes = mir::VplTree::bytes_for(100);
    try {
        render(mir::builtin::make("cornell-box"), s);
        FAIL("it was made");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::limit_exceeded);
        CHECK(std::string(e.what()).find("Limits::vpl_tree_bytes") != std::string::npos);
    }
}

TEST_CASE("settings that do not go with cuts are refused") {
    const auto refused = [](auto change) {
        mir::RenderSettings s;
        s.sum = mir::LightSum::cuts;
        CHECK_NOTHROW(s.validate());
        change(s);
        CHECK_THROWS_AS(s.validate(), mir::Error);
    };
    refused([](mir::RenderSettings& s) { s.picks = 0; });
    refused([](mir::RenderSettings& s) { s.picks = 65537; });
    refused([](mir::RenderSettings& s) { s.integrator = mir::Integrator::path; });
    refused([](mir::RenderSettings& s) { s.vsl.enabled = true; });
    refused([](mir::RenderSettings& s) { s.removed_layer = true; });
    refused([](mir::RenderSettings& s) {
        s.sampler = SamplerKind::instant_radiosity;
        s.glossy.enabled = true;
    });
    refused([](mir::RenderSettings& s) { s.normalisation = mir::NormalisationPolicy::prepass; });
}
