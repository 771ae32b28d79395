// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cpu/embree_scene.hpp"
#include "mir/sampling/vpl_roulette.hpp"
#include "mir/shading/lambert.hpp"

namespace mirtest {

/// A scene and its tracer, with all that a sampler with roulette asks for.
struct RouletteStage {
    using Bsdf = mir::Lambert;
    using Probe = mir::ImageProbe<Bsdf, mir::cpu::EmbreeVisibility>;
    using Plain = mir::InstantRadiositySampler<Bsdf, mir::cpu::EmbreeRayCaster>;
    using Roulette = mir::VplRoulette<Bsdf, mir::cpu::EmbreeVisibility>;
    using Sampler =
        mir::RouletteRadiositySampler<Bsdf, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility>;

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Bsdf> surfaces{scene};
    mir::cpu::EmbreeScene embree{geometry};
    mir::VplShading<Bsdf> shading{.bound = 3.0f};
    mutable mir::InlineExecutor executor;

    explicit RouletteStage(mir::Scene s) : scene(std::move(s)) {}

    [[nodiscard]] Plain::World world() const {
        return {geometry, lights, surfaces, embree.ray_caster()};
    }
    [[nodiscard]] Probe probe(std::uint64_t seed, std::uint32_t luxels = 64) const {
        return {{scene.cameras[0], 1.0f, luxels, seed},
                embree.ray_caster(),
                surfaces,
                embree.visibility(),
                shading};
    }
    /// VPLs of instant radiosity without roulette.
    [[nodiscard]] mir::VplRecords plain(std::uint64_t seed, std::uint32_t vpls) const {
        mir::InstantRadiosityOptions options;
        options.vpls = vpls;
        options.seed = seed;
        return Plain(world(), options).sample(executor);
    }
};

}  // namespace mirtest
