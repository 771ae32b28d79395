// SPDX-License-Identifier: MIT
#include "mir/concepts/sampler.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/sampler_suite.hpp"
#include "mir/concepts/archetypes.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/catch.hpp"

namespace {

namespace archetype = mir::archetype;

static_assert(mir::Sampler<archetype::Sampler>);

struct WithoutSample : archetype::Sampler {
    void sample();
};
static_assert(!mir::Sampler<WithoutSample>);

struct SamplesOnlyOnce : archetype::Sampler {
    template <class E>
    mir::VplRecords sample(E&) {
        return {};
    }
};
static_assert(!mir::Sampler<SamplesOnlyOnce>);

struct SamplesNumbers : archetype::Sampler {
    template <class E>
    [[nodiscard]] std::vector<float> sample(E&) const {
        return {};
    }
};
static_assert(!mir::Sampler<SamplesNumbers>);

struct WithoutNormalisation : archetype::Sampler {
    struct Unknown {};
    static constexpr Unknown normalisation{};
};
static_assert(!mir::Sampler<WithoutNormalisation>);

using Box = mir::InstantRadiositySampler<mir::CookTorrance, mirtest::BruteForceRayCaster>;
static_assert(mir::Sampler<Box>);

/// All that a sampler in the Cornell box refers to.
struct BoxWorld {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<mir::CookTorrance> surfaces{scene};

    [[nodiscard]] Box sampler(mir::InstantRadiosityOptions options) const {
        return {{geometry, lights, surfaces, mirtest::BruteForceScene(geometry).ray_caster()},
                options};
    }
};

}  // namespace

TEST_CASE("InstantRadiositySampler keeps the axioms of Sampler in all its variants") {
    const BoxWorld world;
    mir::InstantRadiosityOptions options;
    options.vpls = 64;
    options.termination = GENERATE(mir::Termination::roulette, mir::Termination::levels);
    options.sequence = GENERATE(mir::Sequence::random, mir::Sequence::halton);
    options.emitter_vpls = GENERATE(false, true);
    const auto make = [&](std::uint64_t seed) {
        options.seed = seed;
        return world.sampler(options);
    };
    archetype::Executor backwards{archetype::make};
    mirtest::sampler_suite(make, backwards);
}

TEST_CASE("A sampler in a scene without lights yields no record") {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (mir::Material& m : scene.materials) m.emission = {};
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::SurfaceTable<mir::CookTorrance> surfaces(scene);
    const Box sampler({geometry, lights, surfaces, {&geometry}}, {});
    mir::InlineExecutor executor;
    const mir::VplRecords found = sampler.sample(executor);
    CHECK(found.records.empty());
    CHECK(found.emitted_power == 0.0f);
    mirtest::records_are_sound(found);
}
