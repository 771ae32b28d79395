// SPDX-License-Identifier: MIT
//
// Every sampler against the path tracer under the same bound: mean radiance of each bounce, tile by
// tile. Each replicate has its own seed, luxels, bootstrap and P_c, so their variance is inside.
#include "agreement_trial.hpp"
#include "mir/io/gltf_reader.hpp"
#include "support/bent_scene.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"
#include "support/test_sky.hpp"

using namespace mirtest;
using mir::SamplerKind;

// H0: equal means. Welch's test over 16 replicates each, D_2 .. D_5 and their sum, in 12 tiles of
// 16 x 16 luxels and over the image; level 1 % over all of them, 4 scenes and 3 samplers. Seeds 0
// to 15, path tracer 811.
TEST_CASE("IR, BIR and MIR bring the light of the path tracer", "[statistical]") {
    const double level = sidak(0.01, 4 * 3);
    for (const char* name : {"cornell-box", "cornell-inverted", "sphere", "sphere-indirect"}) {
        const Trial trial(mir::builtin::make(name), 32);
        CAPTURE(name);
        CHECK(trial.p_of(instant_radiosity(trial.settings, 512)) > level);
        CHECK(trial.p_of(bidirectional(trial.settings)) > level);
        CHECK(trial.p_of(metropolis(trial.settings)) > level);
    }
}

// H0 and test as above, 3 scenes: every setting of the chains as it is shipped. The bootstrap grows
// until P_c is known well enough, and each VPL has a chain of its own that starts on it.
TEST_CASE("MIR as it is shipped brings the light of the path tracer", "[statistical]") {
    const double level = sidak(0.01, 3);
    for (const char* name : {"cornell-box", "cornell-inverted", "sphere-indirect"}) {
        const Trial trial(mir::builtin::make(name), 32);
        mir::RenderSettings shipped = trial.settings;
        shipped.sampler = SamplerKind::metropolis;
        shipped.vpls = 2048;  // for which the fewest paths do not suffice
        const mir::RenderStatistics s = render(trial.studio.scene, shipped).statistics;
        CAPTURE(name);
        REQUIRE(s.health);
        CHECK(s.health->chains == shipped.vpls);
        CHECK(s.health->luminance.paths > shipped.metropolis.bootstrap.min_paths);
        CHECK(trial.p_of(shipped) > level);
    }
}

// H0 and test as above, over the ways to run the chains on two scenes.
TEST_CASE("MIR brings the light of the path tracer however its chains run",
          "[statistical][extended]") {
    constexpr auto variants = 7;
    const double level = sidak(0.01, 2 * variants);
    for (const char* name : {"cornell-inverted", "sphere-indirect"}) {
        const Trial trial(mir::builtin::make(name), 32);
        std::vector<mir::RenderSettings> s(variants, metropolis(trial.settings));
        s[0].metropolis.chain.mutation = mir::Mutation::bidirectional;
        s[1].metropolis.techniques = mir::PathTechniques::camera;
        s[2].normalisation = mir::NormalisationPolicy::prepass;
        s[3].metropolis.suffix_refresh = 0;
        s[4].metropolis.stride = 1;
        s[4].metropolis.chain.tries = 1;
        s[5].metropolis.chain.large_step_probability = 0.05;
        s[6].normalisation = mir::NormalisationPolicy::proposal;
        s[6].metropolis.stride = 2;
        for (std::size_t i = 0; i < s.size(); ++i) {
            CAPTURE(name, i);
            CHECK(trial.p_of(s[i]) > level);
        }
    }
}

// H0 and test as above, 3 samplers, and 2 comparisons between them. Camera paths seldom find the
// lamps of the other room: the path tracer's means come close to a normal law over the whole image
// only. In tiles the samplers are compared with one another; light paths from the lamps share
// nothing with chains of full paths.
TEST_CASE("IR, BIR and MIR bring the light of the path tracer to the room behind a door ajar",
          "[statistical]") {
    const double level = sidak(0.01, 3 + 2);
    const Trial trial(mir::builtin::make("door-ajar"), 192);
    const BounceMeans light_paths = trial.rendered(instant_radiosity(trial.settings, 4096));
    const BounceMeans resampled = trial.rendered(bidirectional(trial.settings));
    const BounceMeans chained = trial.rendered(metropolis(trial.settings));
    CHECK(agreement(light_paths.images(), trial.truth.images()) > level);
    CHECK(agreement(resampled.images(), trial.truth.images()) > level);
    CHECK(agreement(chained.images(), trial.truth.images()) > level);
    CHECK(agreement(chained, light_paths) > level);
    CHECK(agreement(chained, resampled) > level);
}

// H0 and test as above, 3 samplers.
TEST_CASE("IR, BIR and MIR bring the light of the path tracer to Veach's room",
          "[statistical][extended]") {
    const auto scenes = shared_scenes();
    if (!scenes) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    const double level = sidak(0.01, 3);
    const Trial trial(mir::read_gltf(*scenes / "veach-ajar/veach-ajar-diffuse.gltf").scene, 64);
    CHECK(trial.p_of(instant_radiosity(trial.settings, 4096)) > level);
    CHECK(trial.p_of(bidirectional(trial.settings)) > level);
    CHECK(trial.p_of(metropolis(trial.settings)) > level);
}

// H0 and test as above, 3 samplers and chains of Veach's mutations, in a Cornell box that a sky
// lights through its open front, next to its lamp.
TEST_CASE("IR, BIR and MIR bring the light of the path tracer under a sky", "[statistical]") {
    const double level = sidak(0.01, 4);
    mir::Scene scene = mir::builtin::make("cornell-box");
    for (mir::Material& m : scene.materials) m.emission = m.emission * 0.1f;
    scene.environment = test_sky();
    scene.environment->scale = 2.0f;
    const Trial trial(scene, 64);
    CHECK(trial.p_of(instant_radiosity(trial.settings, 2048)) > level);
    CHECK(trial.p_of(bidirectional(trial.settings)) > level);
    mir::RenderSettings chains = metropolis(trial.settings);
    CHECK(trial.p_of(chains) > level);
    chains.metropolis.chain.mutation = mir::Mutation::bidirectional;
    CHECK(trial.p_of(chains) > level);
}

// H0 and test as above with 48 replicates, in a room whose normals a map bends by up to 86 degrees,
// so that they often turn away from light or viewer.
TEST_CASE("IR, BIR and MIR bring the light of the path tracer off bent normals", "[statistical]") {
    const double level = sidak(0.01, 3);
    const Trial trial(with_bumps(mir::builtin::make("cornell-box"), 1.5f, 77), 64, 256, 48);
    CHECK(trial.p_of(instant_radiosity(trial.settings, 2048)) > level);
    CHECK(trial.p_of(bidirectional(trial.settings)) > level);
    CHECK(trial.p_of(metropolis(trial.settings)) > level);
}

namespace {

/// A way to make a picture of a chain's records.
using Render = mir::RenderResult (*)(const Trial&, const mir::RenderSettings&);

mir::VplRecords sampled(const Trial& trial, const mir::RenderSettings& s, float bound) {
    mir::TbbExecutor executor;
    return chains(trial.studio, s, bound).sample(executor);
}

/// Renders what normalisation by any responses makes of the chains' records; the responses are
/// of(list of VPLs).
template <class Of>
mir::RenderResult render_normalised(const Trial& trial, const mir::RenderSettings& s,
                                    const Of& of) {
    const mir::VplRecords records = sampled(trial, s, s.bound.value);
    mir::VplList list = aggregate(records);
    normalise(list, of(list), records.path_luminance, records.states);
    return render(trial.studio, s, relit(records, list));
}

/// No mistake: what the renderer does.
mir::RenderResult right(const Trial& trial, const mir::RenderSettings& s) {
    return render_normalised(trial, s, [&](const mir::VplList& list) {
        return responses(trial.studio, s, list, s.bound.value, trial.studio.engine.visibility());
    });
}

/// The responses know of no bound.
mir::RenderResult unbounded_response(const Trial& trial, const mir::RenderSettings& s) {
    return render_normalised(trial, s, [&](const mir::VplList& list) {
        return responses(trial.studio, s, list, std::numeric_limits<float>::max(),
                         trial.studio.engine.visibility());
    });
}

/// The responses know of no obstacle.
mir::RenderResult unshadowed_response(const Trial& trial, const mir::RenderSettings& s) {
    return render_normalised(trial, s, [&](const mir::VplList& list) {
        return responses(trial.studio, s, list, s.bound.value, FreeSight{});
    });
}

/// All VPLs have the same response, and so the same power; the image has its right mean.
mir::RenderResult equal_power(const Trial& trial, const mir::RenderSettings& s) {
    return render_normalised(trial, s, [&](const mir::VplList& list) {
        const auto t =
            responses(trial.studio, s, list, s.bound.value, trial.studio.engine.visibility());
        mir::ImageResponse mean;
        for (const mir::PathVpl& p : list.path_vpls()) {
            const double share = static_cast<double>(p.weight) / s.vpls;
            mean += {t[p.vpl].r * share, t[p.vpl].g * share, t[p.vpl].b * share, 1};
        }
        return std::vector(list.size(), mean);
    });
}

/// P_c is that of paths which may pass through the bound.
mir::RenderResult unbounded_chain(const Trial& trial, const mir::RenderSettings& s) {
    return render(trial.studio, s, chains(trial.studio, s, std::numeric_limits<float>::max()));
}

/// P_c lacks the last bounce.
mir::RenderResult shorter_luminance(const Trial& trial, const mir::RenderSettings& s) {
    mir::VplRecords records = sampled(trial, s, s.bound.value);
    mir::RenderSettings shorter = s;
    shorter.max_bounce = static_cast<std::uint8_t>(s.bounce_limit() - 1);
    records.path_luminance = sampled(trial, shorter, s.bound.value).path_luminance;
    return render(trial.studio, s, Given{records});
}

/// States that a rejection repeats are left out.
mir::RenderResult without_repeats(const Trial& trial, const mir::RenderSettings& s) {
    mir::VplRecords records = sampled(trial, s, s.bound.value);
    const auto last = std::unique(records.records.begin(), records.records.end(), mir::is_same_vpl);
    records.records.erase(last, records.records.end());
    records.states = static_cast<double>(records.records.size());
    return render(trial.studio, s, Given{records});
}

/// p-value of agreement with the path tracer.
double p_of_renders(const Trial& trial, const mir::RenderSettings& s, Render make) {
    return agreement(trial.rendered(s, [&](const auto& with) { return make(trial, with); }),
                     trial.truth);
}

}  // namespace

// The same hypothesis and test, level 1 % over both scenes: true for the first, rejected for the
// others. The bound is low, so that it matters who knows it.
TEST_CASE("MIR that is normalised wrongly does not bring the light of the path tracer",
          "[statistical][extended]") {
    const double level = sidak(0.01, 2);
    for (const char* name : {"cornell-box", "sphere"}) {
        const Trial trial(mir::builtin::make(name), 32, 32);
        const auto p_of = [&](Render make) {
            return p_of_renders(trial, metropolis(trial.settings), make);
        };
        CAPTURE(name);
        CHECK(p_of(right) > level);
        CHECK(p_of(unbounded_response) < level);
        CHECK(p_of(unshadowed_response) < level);
        CHECK(p_of(equal_power) < level);
        CHECK(p_of(unbounded_chain) < level);
        CHECK(p_of(shorter_luminance) < level);
    }
}

// The same, level 1 %, of an independence chain whose proposals are often worth little.
TEST_CASE("a chain without its rejections does not bring the light of the path tracer",
          "[statistical]") {
    const Trial trial(mir::builtin::make("cornell-inverted"), 32);
    mir::RenderSettings s = metropolis(trial.settings);
    s.vpls = 4096;
    s.metropolis.stride = 1;
    s.metropolis.suffix_refresh = 0;
    s.metropolis.techniques = mir::PathTechniques::camera;
    s.metropolis.chain = {.large_step_probability = 1.0, .tries = 1};
    CHECK(p_of_renders(trial, s, right) > 0.01);
    CHECK(p_of_renders(trial, s, without_repeats) < 0.01);
}
