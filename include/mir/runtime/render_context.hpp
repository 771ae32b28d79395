// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/core/monitor.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/runtime/stage_clock.hpp"
#include "mir/scene/world_geometry.hpp"
#include "mir/shading/surface_table.hpp"

namespace mir {

/// What the stages of one render have in common. A view: everything in it must outlive it. `Engine`
/// offers ray_caster() and visibility().
template <Bsdf B, class Engine, Executor E>
struct RenderContext {
    const RenderSettings& settings;   ///< validated
    const WorldGeometry& geometry;    ///< of the scene
    const SurfaceTable<B>& surfaces;  ///< of the scene's materials
    const CameraRays& rays;           ///< of the whole image
    const Engine& engine;             ///< finds where rays end
    E& executor;                      ///< runs the loops of every stage
    Monitor* monitor;                 ///< may be null
    StageClock& clock;                ///< to which stages tell their time

    /// Width / height of the image.
    [[nodiscard]] float aspect() const { return settings.aspect(); }

    /// The same, with the rays of another engine.
    template <class Other>
    [[nodiscard]] RenderContext<B, Other, E> through(const Other& other) const {
        return {settings, geometry, surfaces, rays, other, executor, monitor, clock};
    }
};

}  // namespace mir
