// SPDX-License-Identifier: MIT
#pragma once

#include "host_engine.hpp"
#include "mir/runtime/render_context.hpp"

namespace mir::cpu {

/// One render on the host, after everything was checked.
struct HostRender {
    const Scene& scene;
    const RenderSettings& settings;
    const WorldGeometry& geometry;
    TbbExecutor& executor;
    Monitor* monitor;
    StageClock& clock;
    HostScheduler scheduler;
};

/// Renders as an integrator does, in a file of its own each. Lambertian scenes get the model with
/// three parameters a luxel instead of eight.
template <Bsdf B>
RenderResult render_by_vpls(const HostRender& r, const HostEngine& engine);
template <Bsdf B>
RenderResult render_by_paths(const HostRender& r, const AnyEngine& engine);
template <Bsdf B>
RenderResult render_from_discs(const HostRender& r, const AnyEngine& engine);

}  // namespace mir::cpu
