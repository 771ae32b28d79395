// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cpu/embree_scene.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/surface_table.hpp"

namespace mirtest {

/// A scene with everything that paths run through.
template <mir::Bsdf B>
struct TracedScene {
    explicit TracedScene(mir::Scene s) : scene(std::move(s)) {}
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;
    ~TracedScene() = default;

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<B> surfaces{scene};
    mir::cpu::EmbreeScene engine{geometry};
};

}  // namespace mirtest
