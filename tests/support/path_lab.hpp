// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/paths/path_generator.hpp"
#include "support/statistics.hpp"
#include "support/traced_scene.hpp"

#include <algorithm>

namespace mirtest {

/// A scene that full paths run through.
template <mir::Bsdf B>
struct PathLab : TracedScene<B> {
    using World = mir::PathWorld<B, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility>;

    using TracedScene<B>::TracedScene;

    [[nodiscard]] World world(float bound = std::numeric_limits<float>::max()) const {
        return {this->geometry,
                this->lights,
                this->surfaces,
                this->engine.ray_caster(),
                this->engine.visibility(),
                this->scene.cameras.front(),
                1.0f,
                bound};
    }
};

/// Builds a path by one technique, the length given too. Nothing about how likely that was.
template <class World>
bool build_by(const World& world, mir::Technique t, const mir::Random& u, mir::Path& path) {
    const std::uint32_t from_eye = t.edges - t.from_light;
    if (!start_at_camera(world, u, path) || !extend_from_eye(world, u, from_eye, path) ||
        !close_path(world, u, t.from_light, path))
        return false;
    path.spread = spread_at(u);
    return t.from_light == 0 || edge_is_free(world, path, from_eye);
}

/// Weights of paths that one technique builds, over `density` of (Path, PathMeasure).
template <class World, class Density>
Moments technique_weights(const World& world, mir::Technique t, std::uint64_t seed,
                          std::uint64_t paths, const Density& density) {
    Moments moments;
    mir::WeightedPath p;
    for (std::uint64_t i = 0; i < paths; ++i) {
        const mir::Random u(seed, mir::Stream::test, i);
        p.weight = 0.0;
        if (build_by(world, t, u, p.path))
            weigh(world, p, [&](const mir::PathMeasure& m) { return density(p.path, m); });
        moments.add(p.weight);
    }
    return moments;
}

/// Weights of a generator's paths.
template <class World>
Moments generator_weights(const World& world, const mir::TechniqueTable& table, std::uint64_t seed,
                          std::uint64_t paths) {
    const mir::PathGenerator<World> generator(world, table);
    Moments moments;
    mir::WeightedPath p;
    for (std::uint64_t i = 0; i < paths; ++i) {
        generator.generate(mir::Random(seed, mir::Stream::test, i), p);
        moments.add(p.weight);
    }
    return moments;
}

}  // namespace mirtest
