// SPDX-License-Identifier: MIT
#include "mir/sampling/metropolis_sampler.hpp"

#include "conformance/sampler_suite.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"
#include "support/wedge.hpp"

#include <array>
#include <cmath>

namespace {

using mir::ChainStop;
using mir::Lambert;
using mir::MetropolisOptions;
using mir::MetropolisSampler;
using mir::Mutation;
using mir::PathTechniques;
using mir::VplKind;
using mir::VplRecords;
using mirtest::Approx;
using mirtest::PathLab;
using mirtest::Wedge;
using mirtest::WedgeLights;

/// Few enough paths for a test.
MetropolisOptions small(Mutation mutation = Mutation::primary, std::uint64_t seed = 7) {
    MetropolisOptions o;
    o.states = 64;
    o.chains = 8;
    o.stride = 8;
    o.chain.mutation = mutation;
    o.bootstrap = {0.1, 2000, 100'000};
    o.seed = seed;
    return o;
}

template <class World>
VplRecords sample(const World& world, const MetropolisOptions& options) {
    mir::InlineExecutor executor;
    return MetropolisSampler<World>(world, options).sample(executor);
}

/// Summed weight of the records from index `first` on that belong to one state.
std::vector<double> weights_of_states(const VplRecords& from, std::uint32_t refreshes) {
    std::vector<double> sums;
    for (std::size_t i = 0; i < from.records.size();) {
        const bool alone = from.records[i].origin.kind == VplKind::emitter;
        const std::size_t end = i + (alone ? 1 : 1 + refreshes);
        double sum = 0.0;
        for (; i < end; ++i) sum += static_cast<double>(from.records[i].weight);
        sums.push_back(sum);
    }
    return sums;
}

/// A lit square that covers some thousandth of the film: few large steps find it.
mir::Scene spark() {
    mir::Scene scene = mir::builtin::parallel_squares();
    scene.cameras[0].vertical_fov = 2.9f;
    return scene;
}

}  // namespace

TEST_CASE("MetropolisSampler keeps the axioms of Sampler") {
    const auto mutation = GENERATE(Mutation::primary, Mutation::bidirectional);
    const auto techniques = GENERATE(PathTechniques::camera, PathTechniques::bidirectional);
    const PathLab<Lambert> lab(Wedge(WedgeLights::two_sided).scene());
    using World = PathLab<Lambert>::World;
    mir::TbbExecutor two(2);
    mir::TbbExecutor five(5);
    mirtest::sampler_suite(
        [&](std::uint64_t seed) {
            MetropolisOptions o = small(mutation, seed);
            o.techniques = techniques;
            return MetropolisSampler<World>(lab.world(), o);
        },
        two, five);
}

TEST_CASE("a fixed stop records as many states as asked for, each with the weight of one") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-inverted"));
    MetropolisOptions o = small();
    o.states = GENERATE(1u, 3u, 8u, 61u);
    o.suffix_refresh = GENERATE(0u, 5u);
    CAPTURE(o.states, o.suffix_refresh);
    const VplRecords r = sample(lab.world(), o);
    const auto weights = weights_of_states(r, o.suffix_refresh);
    CHECK(r.states == o.states);
    CHECK(r.health->recorded_states == o.states);
    CHECK(r.health->chains == std::min(o.states, o.chains));
    CHECK_FALSE(r.health->capped);
    REQUIRE(weights.size() == o.states);
    for (double w : weights) CHECK(w == Approx(1.0).epsilon(1e-5));
    mirtest::records_are_sound(r);
    CHECK(std::isfinite(r.health->effective_samples));
    CHECK(r.health->effective_samples <= o.states);
}

TEST_CASE("records of one state lie at one geometric VPL, and bounces within the range") {
    const PathLab<mir::CookTorrance> lab(Wedge(WedgeLights::ceiling, 1.0f).scene());
    MetropolisOptions o = small(Mutation::bidirectional);
    o.max_bounce = 4;
    const VplRecords r = sample(lab.world(), o);
    const std::size_t per_state = 1 + o.suffix_refresh;
    for (std::size_t i = 0; i < r.records.size(); ++i) {
        CHECK(is_same_vpl(r.records[i], r.records[i - i % per_state]));
        CHECK(r.records[i].bounce >= 2);
        CHECK(r.records[i].bounce <= 4);
        CHECK(luminance(r.records[i].vpl.intensity) == Approx(1.0f).epsilon(1e-4));
    }
    CHECK(r.non_lambertian_share > 0.0f);
}

TEST_CASE("the health counts what the chains did") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-inverted"));
    const auto mutation = GENERATE(Mutation::primary, Mutation::bidirectional);
    const MetropolisOptions o = small(mutation);
    const mir::ChainHealth h = *sample(lab.world(), o).health;
    // The first state of a chain is its start.
    CHECK(h.mutations == (o.states - o.chains) * o.stride);
    CHECK(h.mutations == h.large.proposed + h.small.proposed + h.bidirectional.proposed);
    CHECK((mutation == Mutation::primary ? h.bidirectional : h.small).proposed == 0);
    CHECK(h.suffix.proposed == o.states * o.suffix_refresh);
    CHECK(h.large_step_luminance.paths == h.large.proposed * o.chain.tries);
    CHECK(h.distinct_vpls <= h.recorded_states);
    CHECK(h.large.rate() > 0.0);
    CHECK(h.suffix.rate() > 0.0);
    CHECK(h.longest_stay < h.mutations);
    CHECK(std::fabs(h.luminance_z()) < 5.0);
}

TEST_CASE("emitter VPLs stand on lamps and bring direct light, which no other VPL does") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    MetropolisOptions o = small();
    o.states = 200;
    for (const mir::VplRecord& r : sample(lab.world(), o).records) CHECK(r.bounce >= 2);
    o.emitter_vpls = true;
    const VplRecords with = sample(lab.world(), o);
    double direct = 0.0;
    for (const mir::VplRecord& r : with.records) {
        CHECK((r.bounce == 1) == (r.origin.kind == VplKind::emitter));
        if (r.bounce != 1) continue;
        direct += static_cast<double>(r.weight);
        CHECK(lab.lights.light_of(r.origin.triangle));
        CHECK(r.vpl.normal.y == Approx(-1.0f));
    }
    // Direct light is a good half of the Cornell box.
    CHECK(direct > 60.0);
    CHECK(direct < 180.0);
    for (double w : weights_of_states(with, o.suffix_refresh))
        CHECK(w == Approx(1.0).epsilon(1e-5));
}

TEST_CASE("scenes with lights without extent alone yield reflective VPLs") {
    const auto lights = GENERATE(WedgeLights::point, WedgeLights::spot, WedgeLights::directional);
    const PathLab<Lambert> lab(Wedge(lights).scene());
    MetropolisOptions o = small(Mutation::bidirectional);
    o.emitter_vpls = GENERATE(false, true);
    const VplRecords r = sample(lab.world(), o);
    CHECK(r.states == o.states);
    mirtest::records_are_sound(r);
    for (const mir::VplRecord& record : r.records) CHECK(record.bounce >= 2);
}

TEST_CASE("scenes without light yield no records and say so") {
    mir::Scene black = mir::builtin::furnace_box();
    black.materials[0].base_color = {0, 0, 0};
    mir::Scene off = mir::builtin::furnace_box();
    off.materials[0].emission = {0, 0, 0};
    const bool lamp = GENERATE(true, false);
    const PathLab<Lambert> lab(lamp ? black : off);
    const VplRecords r = sample(lab.world(), small());
    CHECK(r.records.empty());
    CHECK(r.states == 0.0);
    CHECK(r.path_luminance == 0.0);
    REQUIRE(r.health.has_value());
    CHECK(r.health->luminance.mean == 0.0);
    CHECK(r.health->luminance.paths == (lamp ? 100'000u : 0u));
}

TEST_CASE("chains that never move record their state, and are worth one state each") {
    const PathLab<Lambert> lab(spark());
    MetropolisOptions o = small();
    o.emitter_vpls = true;
    o.chains = GENERATE(1u, 2u);
    o.stride = 1;
    o.states = 16;
    o.chain.large_step_probability = 1.0;
    o.chain.tries = 1;
    const VplRecords r = sample(lab.world(), o);
    REQUIRE(r.health->large.accepted == 0);
    CHECK(r.states == o.states);
    CHECK(r.health->longest_stay == o.states / o.chains - 1);
    CHECK(r.health->distinct_vpls == o.chains);
    CHECK(r.health->effective_samples == o.chains);
    mirtest::records_are_sound(r);
}

TEST_CASE("the paper's stop gives up on chains that never move, and says so") {
    const PathLab<Lambert> lab(spark());
    MetropolisOptions o = small();
    o.emitter_vpls = true;
    o.stop = ChainStop::paper;
    o.states = o.chains = 1;
    o.stride = 1;
    o.chain.large_step_probability = 1.0;
    o.chain.tries = 1;
    o.seed = 8;
    const mir::ChainHealth h = *sample(lab.world(), o).health;
    REQUIRE(h.large.accepted == 0);
    CHECK(h.capped);
    CHECK(h.recorded_states == 64);
}

TEST_CASE("the paper's stop ends after its number of new VPLs or at its cap") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-inverted"));
    MetropolisOptions o = small();
    o.stop = ChainStop::paper;
    const mir::ChainHealth h = *sample(lab.world(), o).health;
    CHECK_FALSE(h.capped);
    // One more per chain: the first VPL is not counted.
    CHECK(h.distinct_vpls == o.states + o.chains);
    CHECK(h.recorded_states >= h.distinct_vpls);
}

TEST_CASE("P_c over n does not depend on how the states are shared out") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-inverted"));
    MetropolisOptions o = small();
    const VplRecords a = sample(lab.world(), o);
    o.chains = 1;
    o.suffix_refresh = 0;
    const VplRecords b = sample(lab.world(), o);
    CHECK(a.path_luminance == b.path_luminance);
    CHECK(a.states == b.states);
}

namespace {

/// p-value, after Sidak, of "P_c / n times the weight of bounce b is D_b = rho^b L_e" for bounces 2
/// to 5 in the furnace; `count(records, i)` says what record i counts for.
template <class Count>
double p_of_bounces(Mutation mutation, const Count& count) {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    MetropolisOptions o = small(mutation);
    o.states = 32;
    o.chains = 2;
    o.stride = 1;
    o.max_bounce = 5;
    o.suffix_refresh = 3;
    o.bootstrap = {1.0, 256, 256};
    std::array<mirtest::Moments, 6> bounces;
    for (o.seed = 900; o.seed < 1500; ++o.seed) {
        const VplRecords r = sample(lab.world(), o);
        std::array<double, 6> sums{};
        for (std::size_t i = 0; i < r.records.size(); ++i)
            sums[r.records[i].bounce] += count(r.records, i) * r.path_luminance / r.states;
        for (std::size_t b = 2; b <= 5; ++b) bounces[b].add(sums[b]);
    }
    double smallest = 1.0;
    for (std::size_t b = 2; b <= 5; ++b) {
        const double wanted = 0.5 * std::pow(0.5, b);
        UNSCOPED_INFO("bounce " << b << ": " << bounces[b].mean() << " of " << wanted << " +- "
                                << bounces[b].standard_error());
        smallest = std::min(smallest, mirtest::mean_p_value(bounces[b], wanted));
    }
    return -std::expm1(4 * std::log1p(-smallest));
}

}  // namespace

// H0: records of bounce b bring D_b on average. Student's t over 600 seeds from 900 on, 1 % over 2
// mutations and 4 bounces.
TEST_CASE("in the furnace each bounce gets its share of the records", "[statistical]") {
    const auto mutation = GENERATE(Mutation::primary, Mutation::bidirectional);
    const double p = p_of_bounces(mutation, [](const auto& records, std::size_t i) {
        return static_cast<double>(records[i].weight);
    });
    CHECK(p > mirtest::sidak(0.01, 2));
}

TEST_CASE("records of repeated VPLs that are dropped are missed", "[statistical]") {
    const double p = p_of_bounces(Mutation::bidirectional, [](const auto& records, std::size_t i) {
        const bool again = i >= 4 && is_same_vpl(records[i - 4], records[i]);
        return again ? 0.0 : static_cast<double>(records[i].weight);
    });
    CHECK(p < 1e-6);
}
