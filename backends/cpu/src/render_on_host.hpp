// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cpu/any_scheduler.hpp"
#include "mir/cpu/tbb_executor.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/micro_render.hpp"
#include "mir/runtime/path_render.hpp"
#include "mir/runtime/tiled_render.hpp"
#include "mir/shading/lambert.hpp"

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

template <Bsdf B, class Engine>
RenderResult render_with(const HostRender& r, const Engine& engine) {
    CancellableExecutor cancellable(r.executor, r.monitor);
    using E = decltype(cancellable);
    if (r.settings.integrator == Integrator::path)
        return PathRender<B, Engine, E>(r.scene, r.settings, r.geometry, engine, cancellable,
                                        r.monitor, r.clock)
            .run();
    if (r.settings.integrator == Integrator::micro)
        return MicroRender<B, Engine, E>(r.scene, r.settings, r.geometry, engine, cancellable,
                                         r.monitor, r.clock)
            .run();
    const auto make = [kind = r.scheduler](E& executor, Monitor* monitor) {
        return AnyScheduler<E>{kind, executor, monitor};
    };
    return TiledRender<B, Engine, E, decltype(make)>(r.scene, r.settings, r.geometry, engine,
                                                     cancellable, r.monitor, r.clock, make)
        .run();
}

/// Renders with one ray engine, in a file of its own each, because each takes the compiler long.
/// Lambertian scenes get the model with three parameters a luxel instead of eight.
template <class Engine>
RenderResult render_any(const HostRender& r, const Engine& engine) {
    return is_lambertian(r.scene) ? render_with<Lambert>(r, engine)
                                  : render_with<CookTorrance>(r, engine);
}

}  // namespace mir::cpu
