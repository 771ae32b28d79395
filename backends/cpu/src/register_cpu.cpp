// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"
#include "mir/cpu/register.hpp"
#include "mir/cpu/tbb_executor.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/path_render.hpp"
#include "mir/runtime/tiled_render.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/lambert.hpp"

namespace mir::cpu {
namespace {

/// How a renderer arranges contributions in time.
enum class Arrangement { plain, blocks };

template <Bsdf B, class MakeScheduler>
RenderResult render_with(const Scene& scene, const RenderSettings& settings,
                         const WorldGeometry& geometry, const EmbreeScene& engine,
                         TbbExecutor& executor, Monitor* monitor, MakeScheduler make) {
    CancellableExecutor cancellable(executor, monitor);
    if (settings.integrator == Integrator::path)
        return PathRender<B, EmbreeScene, decltype(cancellable)>(scene, settings, geometry, engine,
                                                                 cancellable, monitor)
            .run();
    return TiledRender<B, EmbreeScene, decltype(cancellable), MakeScheduler>(
               scene, settings, geometry, engine, cancellable, monitor, make)
        .run();
}

/// Lambertian scenes get the model with three parameters a luxel instead of eight.
template <class MakeScheduler>
RenderResult render_any(const Scene& scene, const RenderSettings& settings,
                        const WorldGeometry& geometry, const EmbreeScene& engine,
                        TbbExecutor& executor, Monitor* monitor, MakeScheduler make) {
    if (is_lambertian(scene))
        return render_with<Lambert>(scene, settings, geometry, engine, executor, monitor, make);
    return render_with<CookTorrance>(scene, settings, geometry, engine, executor, monitor, make);
}

class CpuRenderer : public Renderer {
 public:
    explicit CpuRenderer(Arrangement arrangement) : arrangement_(arrangement) {}

    RenderResult render(const Scene& scene, const RenderSettings& settings,
                        Monitor* monitor) const override {
        settings.validate();
        std::vector<std::string> warnings = check_scene(scene, settings);
        double total = 0.0;
        double build = 0.0;
        RenderResult result = [&] {
            const Stopwatch watch(total);
            return timed_render(scene, settings, monitor, build);
        }();
        RenderStatistics& s = result.statistics;
        s.seconds.build = build;
        s.seconds.total = total;
        s.scheduler = arrangement_ == Arrangement::plain ? "cpu" : "cpu-blocks";
        s.scene_hash = SceneHash(scene).hex();
        add_result_warnings(result, warnings);
        result.warnings = std::move(warnings);
        return result;
    }

 private:
    RenderResult timed_render(const Scene& scene, const RenderSettings& settings, Monitor* monitor,
                              double& build) const {
        TbbExecutor executor(settings.threads);
        std::optional<WorldGeometry> geometry;
        std::optional<EmbreeScene> engine;
        {
            const Stopwatch watch(build);
            geometry.emplace(scene, settings.limits);
            engine.emplace(*geometry);
        }
        if (monitor != nullptr) monitor->check();
        RenderResult result = dispatch(scene, settings, *geometry, *engine, executor, monitor);
        result.statistics.triangles = geometry->triangles().size();
        result.statistics.dropped_triangles = geometry->dropped_triangles();
        return result;
    }

    RenderResult dispatch(const Scene& scene, const RenderSettings& settings,
                          const WorldGeometry& geometry, const EmbreeScene& engine,
                          TbbExecutor& executor, Monitor* monitor) const {
        if (arrangement_ == Arrangement::plain)
            return render_any(scene, settings, geometry, engine, executor, monitor,
                              [](auto& e, Monitor* m) {
                                  return sched::Cpu{e, m};
                              });
        return render_any(scene, settings, geometry, engine, executor, monitor,
                          [](auto& e, Monitor* m) {
                              return sched::CpuBlocks{e, m};
                          });
    }

    Arrangement arrangement_;
};

}  // namespace

void add_to(Registry& registry) {
    registry.add("cpu", [] { return std::make_unique<CpuRenderer>(Arrangement::plain); });
    registry.add("cpu-blocks", [] { return std::make_unique<CpuRenderer>(Arrangement::blocks); });
}

std::string description() {
    const char* sets[] = {"baseline", "AVX2", "AVX-512"};
    return "Embree " RTC_VERSION_STRING ", " +
           std::string(sets[static_cast<int>(best_instruction_set())]) + " loops";
}

}  // namespace mir::cpu
