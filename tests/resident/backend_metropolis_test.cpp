// SPDX-License-Identifier: MIT
#include "mir/resident/backend_metropolis.hpp"

#include "mir/host/tbb_executor.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/chain_scene.hpp"
#include "support/lazy_backend.hpp"
#include "support/same_records.hpp"
#include "support/wedge.hpp"

// The records of chains that run as kernels are those of MetropolisSampler in every bit.

namespace {

using mir::ChainStop;
using mir::CookTorrance;
using mir::Lambert;
using mir::MetropolisOptions;
using mir::Mutation;
using mir::VplRecords;
using mirtest::chains_on;
using mirtest::ChainScene;
using mirtest::few_chains;
using mirtest::same_health;
using mirtest::same_records;
using mirtest::Wedge;
using mirtest::WedgeLights;

template <mir::Bsdf B>
void check_on_cpu(const mir::Scene& scene, const MetropolisOptions& options) {
    const ChainScene<B> stage(scene);
    const VplRecords wanted = stage.sampled_on_host(options);
    mir::TbbExecutor threads(3);
    const VplRecords found = chains_on(mir::host::Backend(threads), stage.parts(), options);
    REQUIRE(!wanted.records.empty());
    CHECK(same_records(found, wanted));
    CHECK(same_health(*found.health, *wanted.health));
}

}  // namespace

TEST_CASE("Chains on a backend make the sampler's records, whatever the light") {
    const auto lights = GENERATE(WedgeLights::ceiling, WedgeLights::two_sided, WedgeLights::point,
                                 WedgeLights::spot, WedgeLights::directional);
    const auto mutation = GENERATE(Mutation::primary, Mutation::bidirectional);
    check_on_cpu<Lambert>(Wedge(lights).scene(), few_chains(mutation));
    check_on_cpu<CookTorrance>(Wedge(lights, 1.0f).scene(), few_chains(mutation));
}

TEST_CASE("Chains on a backend make the sampler's records through a lens") {
    mir::Scene scene = mir::builtin::make("cornell-inverted");
    scene.cameras[0].lens_radius = 0.1f;
    scene.cameras[0].focus_distance = 2.0f;
    check_on_cpu<Lambert>(scene, few_chains(Mutation::primary));
    check_on_cpu<CookTorrance>(scene, few_chains(Mutation::bidirectional));
}

TEST_CASE("Chains on a backend make the sampler's records however they are cut") {
    MetropolisOptions options = few_chains(Mutation::primary);
    SECTION("a single VPL") { options.states = 1; }
    SECTION("a single chain") { options.chains = 1; }
    SECTION("chains of unequal length") { options.states = 29; }
    SECTION("a shorter chain whose trace is longer") {
        // 65 states, 4096 steps, every second kept; 64 states, 4032 steps, all kept.
        options.chains = 2;
        options.states = 129;
        options.stride = 64;
    }
    SECTION("no suffixes") { options.suffix_refresh = 0; }
    SECTION("lamps as VPLs") { options.emitter_vpls = true; }
    SECTION("paths from the camera alone") { options.techniques = mir::PathTechniques::camera; }
    SECTION("the paper's stopping rule") {
        options.states = 12;
        options.stop = ChainStop::paper;
    }
    SECTION("more paths than one kernel draws") { options.bootstrap = {1e-9, 300'000, 300'000}; }
    check_on_cpu<Lambert>(Wedge(WedgeLights::two_sided).scene(), options);
}

TEST_CASE("Chains that do not fit into memory together run in turn") {
    const ChainScene<Lambert> stage(Wedge(WedgeLights::ceiling).scene());
    const MetropolisOptions options = few_chains(Mutation::primary);
    const VplRecords wanted = stage.sampled_on_host(options);
    mir::InlineExecutor one;
    const mir::host::Backend backend(one);
    for (const std::uint64_t bytes : {1, 200'000}) {
        const VplRecords found = chains_on(backend, stage.parts(), options, {.bytes = bytes});
        CHECK(same_records(found, wanted));
        CHECK(same_health(*found.health, *wanted.health));
    }
}

TEST_CASE("Chains wait for what they read on a backend that is late") {
    const std::uint32_t eager = GENERATE(0u, 1u);
    const ChainScene<CookTorrance> stage(Wedge(WedgeLights::spot, 1.0f).scene());
    const MetropolisOptions options = few_chains(Mutation::bidirectional);
    mirtest::PutOff work(eager);
    const VplRecords found = chains_on(mirtest::LazyBackend(work), stage.parts(), options);
    CHECK(same_records(found, stage.sampled_on_host(options)));
}

TEST_CASE("Without light chains on a backend make no record") {
    mir::Scene scene = Wedge(WedgeLights::point).scene();
    const bool is_off = GENERATE(true, false);
    if (is_off)
        scene.point_lights.clear();
    else
        for (mir::Material& m : scene.materials) m.base_color = {};
    MetropolisOptions options = few_chains(Mutation::primary);
    options.bootstrap.max_paths = options.bootstrap.min_paths;
    const ChainScene<Lambert> stage(scene);
    mir::InlineExecutor one;
    const VplRecords found = chains_on(mir::host::Backend(one), stage.parts(), options);
    const VplRecords wanted = stage.sampled_on_host(options);
    CHECK(found.records.empty());
    CHECK(found.emitted_power == wanted.emitted_power);
    CHECK(found.paths == wanted.paths);
    CHECK(found.health->luminance.paths == wanted.health->luminance.paths);
}

TEST_CASE("Another seed is told from the same one") {
    const ChainScene<Lambert> stage(Wedge(WedgeLights::ceiling).scene());
    MetropolisOptions options = few_chains(Mutation::primary);
    const VplRecords one = stage.sampled_on_host(options);
    ++options.seed;
    const VplRecords other = stage.sampled_on_host(options);
    CHECK_FALSE(same_records(one, other));
    CHECK_FALSE(same_health(*one.health, *other.health));
}

TEST_CASE("Chains on a backend refuse what MetropolisSampler refuses, and stop when told to") {
    const ChainScene<Lambert> stage(Wedge(WedgeLights::ceiling).scene());
    mir::InlineExecutor one;
    const mir::host::Backend backend(one);
    MetropolisOptions options = few_chains(Mutation::primary);
    options.states = 0;
    CHECK_THROWS_AS(chains_on(backend, stage.parts(), options), mir::Error);
    mir::Monitor monitor;
    monitor.cancelled = true;
    auto queue = backend.queue();
    const mir::BackendMetropolis chains(backend, stage.world(), few_chains(Mutation::primary));
    CHECK_THROWS_AS(chains.sample(queue, &monitor), mir::Error);
}
