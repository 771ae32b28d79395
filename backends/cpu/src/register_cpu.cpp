// SPDX-License-Identifier: MIT
#include "host_render.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/cpu/register.hpp"
#include "mir/host/shaft_scene.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/check_world.hpp"
#include "mir/runtime/near_scene.hpp"
#include "mir/scene/scene_hash.hpp"

#include <algorithm>
#include <cmath>

namespace mir::cpu {

extern template class HostEngineOf<EmbreeScene>;
extern template class HostEngineOf<KdTreeScene>;
extern template class HostEngineOf<ShaftScene>;

namespace {

template <Bsdf B>
RenderResult render_with(const HostRender& r, const HostEngine& engine) {
    switch (r.settings.integrator) {
        case Integrator::path:
            return render_by_paths<B>(r, engine.any());
        case Integrator::micro:
            return render_from_discs<B>(r, engine.any());
        case Integrator::vpl:
            break;
    }
    return render_by_vpls<B>(r, engine);
}

/// Luxels times VPLs from which shafts save more time than our hierarchy takes longer to build than
/// Embree's: 128 for each triangle, more where triangles are so many that shafts decide less
/// (docs/decisions/012). The number of threads has no say, as in all that
/// may change a bit.
double pairs_that_pay(double triangles) {
    constexpr double many = 1e6;
    return 128 * triangles * std::max(1.0, std::sqrt(triangles / many));
}

/// Paths and discs ask ray by ray, which Embree answers fastest; so do luxels where masks forbid
/// shafts.
Acceleration structure_of(const HostRender& render) {
    const RenderSettings& s = render.settings;
    if (s.acceleration != Acceleration::automatic) return s.acceleration;
    const double triangles = static_cast<double>(render.geometry.triangles().size());
    const bool asks_blocks = s.integrator == Integrator::vpl && !render.geometry.is_masked();
    return asks_blocks && pairs(s) >= pairs_that_pay(triangles) ? Acceleration::bvh
                                                                : Acceleration::embree;
}

class CpuRenderer : public Renderer {
 public:
    CpuRenderer(std::string_view name, HostScheduler scheduler)
        : name_(name), scheduler_(scheduler) {}

    RenderResult render(const Scene& scene, const RenderSettings& settings,
                        Monitor* monitor) const override {
        settings.validate();
        std::vector<std::string> warnings = check_scene(scene, settings);
        StageClock clock(monitor);
        const NearScene near = near_scene(scene, clock, warnings);
        RenderResult result = build_and_render(near.scene(), settings, monitor, clock);
        RenderStatistics& s = result.statistics;
        s.origin = near.scene().origin;
        s.backend = "cpu";
        s.scheduler = name_;
        {
            const auto stage = clock.measure(&StageSeconds::hash);
            s.scene_hash = SceneHash(scene).hex();
        }
        s.seconds = clock.seconds();
        add_result_warnings(result, warnings);
        result.warnings = std::move(warnings);
        return result;
    }

 private:
    [[nodiscard]] RenderResult build_and_render(const Scene& scene, const RenderSettings& settings,
                                                Monitor* monitor, StageClock& clock) const {
        TbbExecutor executor(settings.threads);
        const WorldGeometry geometry = [&] {
            const auto stage = clock.measure(&StageSeconds::geometry);
            return WorldGeometry(scene, settings.limits, executor);
        }();
        check_world(scene, settings.camera, geometry);
        RenderResult result =
            trace({scene, settings, geometry, executor, monitor, clock, scheduler_});
        count_triangles(geometry, result.statistics);
        return result;
    }

    static RenderResult trace(const HostRender& render) {
        switch (structure_of(render)) {
            case Acceleration::kd_tree:
                return trace_by<KdTreeScene>("kdtree", render, render.executor);
            case Acceleration::bvh:
                return trace_by<ShaftScene>("bvh", render, render.executor);
            case Acceleration::embree:
            case Acceleration::automatic:
                break;
        }
        return trace_by<EmbreeScene>("embree", render);
    }

    /// Builds what rays are traced through, and renders with it.
    template <class TracedScene, class... Options>
    static RenderResult trace_by(const char* name, const HostRender& render, Options&... options) {
        std::optional<TracedScene> traced;
        {
            const auto stage = render.clock.measure(&StageSeconds::build);
            traced.emplace(render.geometry, options...);
        }
        if (render.monitor != nullptr) render.monitor->check();
        const HostEngineOf<TracedScene> engine(*traced);
        RenderResult result = is_lambertian(render.scene)
                                  ? render_with<Lambert>(render, engine)
                                  : render_with<CookTorrance>(render, engine);
        result.statistics.acceleration = name;
        return result;
    }

    std::string name_;
    HostScheduler scheduler_;
};

}  // namespace

void add_to(Registry& registry) {
    Registry::Backend backend{BackendKind::cpu, "cpu", [] {}, "cpu-blocks", {}};
    for (const auto& [name, kind] : host_schedulers)
        backend.schedulers.emplace(
            name, [name = name, kind = kind] { return std::make_unique<CpuRenderer>(name, kind); });
    registry.add(std::move(backend));
}

std::string description() {
    const char* sets[] = {"baseline", "AVX2", "AVX-512"};
    return "Embree " RTC_VERSION_STRING ", " +
           std::string(sets[static_cast<int>(best_instruction_set())]) + " loops";
}

}  // namespace mir::cpu
