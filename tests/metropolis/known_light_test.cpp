// SPDX-License-Identifier: MIT
//
// Samplers that look at the image, in a furnace whose light is known bounce by bounce.
#include "conformance/passes.hpp"
#include "mir/sampling/bidirectional_sampler.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/validation/sampler.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"
#include "validation/finds.hpp"

namespace {

using mir::Lambert;
using mir::VplRecords;
using mir::validation::check_sampler;
using mir::validation::check_sampler_light;
using mir::validation::check_sampler_records;
using mirtest::finds;
using mirtest::finds_only;
using Lab = mirtest::PathLab<Lambert>;
using Metropolis = mir::MetropolisSampler<Lab::World>;

mir::MetropolisOptions small(std::uint64_t seed) {
    mir::MetropolisOptions o;
    o.states = 64;
    o.chains = 16;
    o.stride = 8;
    o.suffix_refresh = 2;
    o.bootstrap = {0.1, 1000, 100'000};
    o.seed = seed;
    return o;
}

/// What is wrong with the records of chains.
enum class Bug { none, twice_the_luminance, repeats_dropped, states_of_others };

/// Metropolis sampling and a bug.
struct Buggy {
    static constexpr mir::Normalisation normalisation = Metropolis::normalisation;

    Metropolis right;
    Bug bug;

    template <mir::Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const {
        VplRecords out = right.sample(executor);
        if (bug == Bug::twice_the_luminance) out.path_luminance *= 2.0;
        if (bug == Bug::repeats_dropped) out.records.resize(out.records.size() * 3 / 4);
        if (bug == Bug::states_of_others) out.states *= 1.5;
        return out;
    }
};

}  // namespace

// H0, level and seeds: see check_sampler_light().
TEST_CASE("samplers that look at the image bring a known furnace its light", "[statistical]") {
    const mir::validation::KnownLight room = mir::validation::known_furnace();
    const Lab lab(room.scene());
    mirtest::passes(check_sampler(
        [&](std::uint64_t seed) { return Metropolis(lab.world(), small(seed)); }, room));

    const mir::ImageProbe<Lambert, mir::cpu::EmbreeVisibility> probe(
        {lab.scene.cameras.front(), 1.0f, 64, 1}, lab.engine.ray_caster(), lab.surfaces,
        lab.engine.visibility());
    mir::BidirectionalOptions resampling;
    resampling.vpls = 256;
    resampling.candidates = 8;
    mirtest::passes(check_sampler(
        [&](std::uint64_t seed) {
            resampling.seed = seed;
            return mir::BidirectionalSampler<Lab::World>(lab.world(), probe, resampling);
        },
        room));
}

TEST_CASE("check_sampler finds luminances and states that are other than the records'",
          "[statistical]") {
    const mir::validation::KnownLight room = mir::validation::known_furnace();
    const Lab lab(room.scene());
    const auto make = [&](Bug bug) {
        return [&lab, bug](std::uint64_t seed) {
            return Buggy{Metropolis(lab.world(), small(seed)), bug};
        };
    };
    const auto bright = check_sampler_light(make(Bug::twice_the_luminance), room);
    CHECK(finds(bright, "P_c is the light of all bounces"));
    CHECK(finds(bright, "all bounces bring their light"));
    for (const Bug bug : {Bug::repeats_dropped, Bug::states_of_others}) {
        CHECK(
            finds_only(check_sampler_records(make(bug)), "weights add up to the recorded states"));
        const auto dark = check_sampler_light(make(bug), room);
        CHECK(finds(dark, "all bounces bring their light"));
        CHECK_FALSE(finds(dark, "P_c is the light of all bounces"));
    }
}
