// SPDX-License-Identifier: MIT
#include "conformance/sampler_suite.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

TEMPLATE_TEST_CASE("InstantRadiositySampler with Embree yields the same records on any executor",
                   "", mir::Lambert, mir::CookTorrance) {
    const mir::Scene scene = mir::builtin::sphere_room(mir::builtin::Lamp::up);
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::SurfaceTable<TestType> surfaces(scene);
    const mir::cpu::EmbreeScene embree(geometry);
    using Sampler = mir::InstantRadiositySampler<TestType, mir::cpu::EmbreeRayCaster>;
    mir::InstantRadiosityOptions options;
    options.vpls = 500;
    options.termination = GENERATE(mir::Termination::roulette, mir::Termination::levels);
    const auto make = [&](std::uint64_t seed) {
        options.seed = seed;
        return Sampler({geometry, lights, surfaces, embree.ray_caster()}, options);
    };
    mir::TbbExecutor threads(4);
    mir::TbbExecutor all;
    mirtest::sampler_suite(make, threads, all);
}
