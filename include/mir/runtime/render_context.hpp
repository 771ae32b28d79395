// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/runtime/stage_clock.hpp"

namespace mir {

/// What the stages of one render have in common. A view: everything in it must outlive it. `Engine`
/// offers ray_caster() and visibility().
template <Bsdf B, class Engine, Executor E>
struct RenderContext {
    const RenderSettings& settings;
    const WorldGeometry& geometry;
    const SurfaceTable<B>& surfaces;
    const CameraRays& rays;
    const Engine& engine;
    E& executor;
    Monitor* monitor;  ///< may be null
    StageClock& clock;

    [[nodiscard]] float aspect() const { return settings.aspect(); }
};

}  // namespace mir
