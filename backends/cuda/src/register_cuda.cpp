// SPDX-License-Identifier: MIT
#include "gpu_engine.hpp"
#include "mir/accel/kd_build.hpp"
#include "mir/accel/wide_build.hpp"
#include "mir/cpu/any_scheduler.hpp"
#include "mir/cuda/register.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/micro_render.hpp"
#include "mir/runtime/path_render.hpp"
#include "mir/runtime/tiled_render.hpp"

namespace mir::cuda {
namespace {

constexpr std::array<std::pair<const char*, GpuScheduler>, 3> schedulers{
    {{"os", GpuScheduler::os}, {"rc", GpuScheduler::rc}, {"rcvp", GpuScheduler::rcvp}}};

/// Luxels scheduled together unless the settings say: enough to fill a large GPU.
constexpr Extent default_gpu_tile{1024, 1024};

/// Smallest tile that running out of memory leads to.
constexpr std::uint32_t least_tile_side = 64;

class CudaRenderer : public Renderer {
 public:
    CudaRenderer(const char* name, GpuScheduler scheduler)
        : name_(name), scheduler_(scheduler), device_(select_device()), backend_(device_) {}

    RenderResult render(const Scene& scene, const RenderSettings& settings,
                        Monitor* monitor) const override {
        settings.validate();
        expects(settings.acceleration != Acceleration::bvh,
                "the CUDA backend traces no rays through a bounding volume hierarchy alone; leave "
                "--accel away for shafts through one, use --accel kdtree, or --backend cpu");
        std::vector<std::string> warnings = check_scene(scene, settings);
        double total = 0.0;
        RenderResult result = [&] {
            const Stopwatch watch(total);
            return render_in_memory(scene, settings, monitor);
        }();
        RenderStatistics& s = result.statistics;
        s.seconds.total = total;
        s.backend = "cuda";
        s.device = device_.name;
        s.acceleration = uses_shafts(settings) ? "kdtree+shafts" : "kdtree";
        s.scheduler = name_;
        s.scene_hash = SceneHash(scene).hex();
        add_result_warnings(result, warnings);
        result.warnings = std::move(warnings);
        return result;
    }

 private:
    [[nodiscard]] static bool uses_shafts(const RenderSettings& settings) {
        return settings.acceleration == Acceleration::automatic &&
               settings.integrator == Integrator::vpl;
    }

    /// Tries again with smaller tiles and bands while the GPU has too little memory.
    [[nodiscard]] RenderResult render_in_memory(const Scene& scene, RenderSettings settings,
                                                Monitor* monitor) const {
        Extent tile = settings.tile.value_or(default_gpu_tile);
        backend_.memory().trim();
        settings.limits.visibility_bytes =
            std::min(settings.limits.visibility_bytes, free_memory(device_.ordinal) / 2);
        for (;;) {
            settings.tile = tile;
            try {
                return build_and_render(scene, settings, monitor);
            } catch (const Error& e) {
                const bool is_smallest =
                    tile.width <= least_tile_side && tile.height <= least_tile_side;
                if (e.code() != ErrorCode::out_of_memory || is_smallest) throw;
            }
            if (monitor != nullptr) monitor->contributions = 0;
            backend_.memory().trim();
            tile = {std::max(tile.width / 2, std::min(tile.width, least_tile_side)),
                    std::max(tile.height / 2, std::min(tile.height, least_tile_side))};
            settings.limits.visibility_bytes /= 2;
        }
    }

    [[nodiscard]] RenderResult build_and_render(const Scene& scene, const RenderSettings& settings,
                                                Monitor* monitor) const {
        const WorldGeometry geometry(scene, settings.limits);
        RenderResult result = is_lambertian(scene)
                                  ? trace<Lambert>(scene, settings, geometry, monitor)
                                  : trace<CookTorrance>(scene, settings, geometry, monitor);
        result.statistics.triangles = geometry.triangles().size();
        result.statistics.dropped_triangles = geometry.dropped_triangles();
        return result;
    }

    template <Bsdf F>
    [[nodiscard]] RenderResult trace(const Scene& scene, const RenderSettings& settings,
                                     const WorldGeometry& geometry, Monitor* monitor) const {
        cpu::TbbExecutor executor(settings.threads);
        double build = 0.0;
        std::optional<KdTree> tree;
        std::optional<GpuEngine<F>> engine;
        {
            const Stopwatch watch(build);
            tree.emplace(geometry, KdTreeOptions::for_gpu(), executor);
            std::optional<WideBvh> bvh;  // read while it is copied alone
            if (uses_shafts(settings)) bvh.emplace(geometry, WideBvhOptions{}, executor);
            engine.emplace(backend_, scene, geometry, *tree, bvh ? &*bvh : nullptr, executor,
                           scheduler_);
        }
        if (monitor != nullptr) monitor->check();
        CancellableExecutor cancellable(executor, monitor);
        RenderResult result = run(scene, settings, geometry, *engine, cancellable, monitor);
        result.statistics.seconds.build = build;
        return result;
    }

    template <Bsdf F, Executor E>
    [[nodiscard]] static RenderResult run(const Scene& scene, const RenderSettings& settings,
                                          const WorldGeometry& geometry, const GpuEngine<F>& engine,
                                          E& executor, Monitor* monitor) {
        // These two trace on the host, whatever the backend.
        if (settings.integrator == Integrator::path)
            return PathRender<F, GpuEngine<F>, E>(scene, settings, geometry, engine, executor,
                                                  monitor)
                .run();
        if (settings.integrator == Integrator::micro)
            return MicroRender<F, GpuEngine<F>, E>(scene, settings, geometry, engine, executor,
                                                   monitor)
                .run();
        // GpuEngine lights bands itself; no scheduler of the host is ever opened.
        const auto none = [](E& loops, Monitor* m) { return sched::Cpu{loops, m}; };
        return TiledRender<F, GpuEngine<F>, E, decltype(none)>(scene, settings, geometry, engine,
                                                               executor, monitor, none)
            .run();
    }

    const char* name_;
    GpuScheduler scheduler_;
    Device device_;
    Backend backend_;
};

}  // namespace

void add_to(Registry& registry) {
    Registry::Backend backend{
        BackendKind::cuda, "cuda", [] { static_cast<void>(select_device()); }, "rcvp", {}};
    for (const auto& [name, scheduler] : schedulers)
        backend.schedulers.emplace(name, [name = name, scheduler = scheduler] {
            return std::make_unique<CudaRenderer>(name, scheduler);
        });
    registry.add(std::move(backend));
}

void append_devices(DeviceList& list) {
    try {
        for (const Device& d : devices()) {
            const std::string name = "cuda:" + std::to_string(d.ordinal);
            if (is_supported(d))
                list.devices.push_back({name,
                                        d.name + ", compute capability " + capability_text(d) +
                                            ", CUDA " + version_text(versions().runtime) +
                                            ", driver for CUDA " + version_text(versions().driver),
                                        d.memory_bytes, d.multiprocessors});
            else
                list.unavailable.push_back(name + ": " + d.name +
                                           " is too old (its compute capability is " +
                                           capability_text(d) + ", kernels need 7.5)");
        }
    } catch (const Error& e) {
        list.unavailable.push_back(std::string("cuda: ") + e.what());
    }
}

}  // namespace mir::cuda
