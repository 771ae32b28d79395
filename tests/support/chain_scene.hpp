// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "support/backend_chains.hpp"

namespace mirtest {

/// Few enough paths for a test.
inline mir::MetropolisOptions few_chains(mir::Mutation mutation) {
    mir::MetropolisOptions o;
    o.states = 48;
    o.chains = 12;
    o.stride = 8;
    o.chain.mutation = mutation;
    o.chain.tries = 3;
    o.suffix_refresh = 3;
    o.bootstrap = {0.1, 2000, 100'000};
    o.seed = 11;
    return o;
}

/// A scene whose kd-tree chains run through.
template <mir::Bsdf F>
struct ChainScene {
    static constexpr float aspect = 1.25f;
    static constexpr float bound = 4.0f;

    explicit ChainScene(mir::Scene s) : scene(std::move(s)) {}
    ChainScene(const ChainScene&) = delete;
    ChainScene& operator=(const ChainScene&) = delete;
    ~ChainScene() = default;

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<F> surfaces{scene};
    mir::KdTreeScene engine{geometry};

    [[nodiscard]] auto world() const {
        return mir::PathWorld{geometry,
                              lights,
                              surfaces,
                              engine.ray_caster(),
                              engine.visibility(),
                              scene.cameras.front(),
                              aspect,
                              bound};
    }
    [[nodiscard]] ChainParts<F> parts() const {
        return {geometry, lights, surfaces, engine.tree(), scene.cameras.front().optics(),
                aspect,   bound};
    }
    [[nodiscard]] mir::VplRecords sampled_on_host(const mir::MetropolisOptions& options) const {
        mir::InlineExecutor one;
        return mir::MetropolisSampler(world(), options).sample(one);
    }
};

}  // namespace mirtest
