// SPDX-License-Identifier: MIT
#include "cuda/metropolis.hpp"

#include "mir/scenes.hpp"
#include "support/catch.hpp"
#include "support/chain_scene.hpp"
#include "support/same_records.hpp"
#include "support/wedge.hpp"

// Chains on the GPU against MetropolisSampler on the host, in every bit.

namespace {

using mir::CookTorrance;
using mir::Lambert;
using mir::MetropolisOptions;
using mir::Mutation;
using mirtest::ChainScene;
using mirtest::few_chains;
using mirtest::Wedge;
using mirtest::WedgeLights;

template <mir::Bsdf F>
void check_on_gpu(const mir::Scene& scene, const MetropolisOptions& options,
                  const mir::ChainPortions& portions = {}) {
    const mir::cuda::Backend backend(mir::cuda::select_device(0));
    const ChainScene<F> stage(scene);
    const mir::VplRecords wanted = stage.sampled_on_host(options);
    const mir::VplRecords found = mirtest::chains_on_gpu(backend, stage.parts(), options, portions);
    REQUIRE(!wanted.records.empty());
    CHECK(mirtest::same_records(found, wanted));
    CHECK(mirtest::same_health(*found.health, *wanted.health));
}

}  // namespace

TEST_CASE("Chains on the GPU make the sampler's records in every bit, whatever the light") {
    const auto lights = GENERATE(WedgeLights::ceiling, WedgeLights::two_sided, WedgeLights::point,
                                 WedgeLights::spot, WedgeLights::directional);
    const auto mutation = GENERATE(Mutation::primary, Mutation::bidirectional);
    CAPTURE(static_cast<int>(lights), static_cast<int>(mutation));
    check_on_gpu<Lambert>(Wedge(lights).scene(), few_chains(mutation));
    check_on_gpu<CookTorrance>(Wedge(lights, 1.0f).scene(), few_chains(mutation));
}

TEST_CASE("Chains on the GPU make the sampler's records through a lens") {
    mir::Scene scene = mir::builtin::make("cornell-inverted");
    scene.cameras[0].lens_radius = 0.1f;
    scene.cameras[0].focus_distance = 2.0f;
    check_on_gpu<Lambert>(scene, few_chains(Mutation::primary));
    check_on_gpu<CookTorrance>(scene, few_chains(Mutation::bidirectional));
}

TEST_CASE("Chains on the GPU make the sampler's records however they are cut") {
    MetropolisOptions options = few_chains(Mutation::primary);
    mir::ChainPortions portions;
    SECTION("a single VPL") { options.states = 1; }
    SECTION("thousands of chains") { options.states = options.chains = 3000; }
    SECTION("the paper's stopping rule") { options.stop = mir::ChainStop::paper; }
    SECTION("not all in memory at a time") { portions.bytes = 200'000; }
    SECTION("a few mutations at a time") { portions.mutations = 5; }
    check_on_gpu<Lambert>(Wedge(WedgeLights::two_sided).scene(), options, portions);
}
