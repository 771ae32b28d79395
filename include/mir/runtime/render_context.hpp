// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"

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
    StageSeconds& seconds;

    [[nodiscard]] float aspect() const {
        return static_cast<float>(settings.image.width) / static_cast<float>(settings.image.height);
    }
};

}  // namespace mir
