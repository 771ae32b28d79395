// SPDX-License-Identifier: MIT
#include "gpu_engine.hpp"
#include "gpu_gather.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/cpu/any_scheduler.hpp"
#include "mir/cuda/register.hpp"
#include "mir/resident/backend_metropolis.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/check_world.hpp"
#include "mir/runtime/micro_render.hpp"
#include "mir/runtime/near_scene.hpp"
#include "mir/runtime/path_render.hpp"
#include "mir/runtime/tiled_render.hpp"

#include <future>

namespace mir::cuda {
namespace {

constexpr std::array<std::pair<const char*, BackendScheduler>, 3> schedulers{
    {{"os", BackendScheduler::os}, {"rc", BackendScheduler::rc}, {"rcvp", BackendScheduler::rcvp}}};

/// What BackendEngine is to build.
struct Structures {
    const char* name;
    bool kd_tree;
    bool shafts;
};
constexpr Structures plain{"kdtree", true, false};
constexpr Structures both{"kdtree+shafts", true, true};
constexpr Structures hierarchy{"bvh", false, true};
constexpr Structures for_masks{"bvh", false, false};

/// Luxels times VPLs from which a kd-tree, which single rays walk faster, is worth the time that
/// the host takes to build it (docs/decisions/031). Bits are the same.
constexpr double kd_tree_pays = 13e9;

Structures structures_of(const Scene& scene, const RenderSettings& settings) {
    if (is_masked(scene)) return for_masks;
    switch (settings.acceleration) {
        case Acceleration::kd_tree:
            return plain;
        case Acceleration::bvh:
            return hierarchy;
        case Acceleration::automatic:
        case Acceleration::embree:  // refused before
            break;
    }
    return pairs(settings) < kd_tree_pays ? hierarchy : both;
}

/// Luxels scheduled together unless the settings say: enough to fill a large GPU.
constexpr Extent default_gpu_tile{1024, 1024};

/// Smallest tile that running out of memory leads to.
constexpr std::uint32_t least_tile_side = 64;

/// A scene of the host whose luxels gather light on a GPU.
template <Bsdf F>
class GatherScene {
 public:
    /// What is passed in must outlive it.
    GatherScene(const KdTreeScene& scene, const Backend& backend)
        : scene_(scene), gather_(backend) {}

    [[nodiscard]] KdTreeVisibility<Space::host> visibility() const { return scene_.visibility(); }
    [[nodiscard]] KdRayCaster<Space::host> ray_caster() const { return scene_.ray_caster(); }
    template <class Options>
    [[nodiscard]] Image<Rgb> gather(const typename GpuGather<F>::Luxels& luxels,
                                    const SurfelTree& tree,
                                    std::span<const SurfelRadiance> radiance,
                                    const Options& options, const LuxelBand& band,
                                    const GatherProgress& done) const {
        return gather_(luxels, tree, radiance, options, band, done);
    }

 private:
    const KdTreeScene& scene_;
    GpuGather<F> gather_;
};

class CudaRenderer : public Renderer {
 public:
    CudaRenderer(const char* name, BackendScheduler scheduler)
        : name_(name), scheduler_(scheduler), device_(select_device()), backend_(device_) {
        // Wakes the GPU, which takes longer than a picture and would count as part of the first.
        static_cast<void>(free_memory(device_.ordinal));
    }

    RenderResult render(const Scene& scene, const RenderSettings& settings,
                        Monitor* monitor) const override {
        settings.validate();
        if (const std::string reason = host_only(settings); !reason.empty())
            throw Error(ErrorCode::unsupported, reason);
        std::vector<std::string> warnings = check_scene(scene, settings);
        StageClock clock(monitor);
        // Beside the GPU: it takes as long as a stage.
        auto hash = std::async(std::launch::async, [&scene] { return SceneHash(scene).hex(); });
        const NearScene near = near_scene(scene, clock, warnings);
        RenderResult result = render_in_memory(near.scene(), settings, monitor, clock);
        RenderStatistics& s = result.statistics;
        s.origin = near.scene().origin;
        s.backend = "cuda";
        s.device = device_.name;
        s.acceleration = settings.integrator != Integrator::vpl
                             ? plain.name
                             : structures_of(scene, settings).name;
        s.scheduler = name_;
        {
            const auto stage = clock.measure(&StageSeconds::hash);
            s.scene_hash = hash.get();
        }
        s.seconds = clock.seconds();
        add_result_warnings(result, warnings);
        result.warnings = std::move(warnings);
        return result;
    }

 private:
    /// Tries again with smaller tiles and bands while the GPU has too little memory.
    [[nodiscard]] RenderResult render_in_memory(const Scene& scene, RenderSettings settings,
                                                Monitor* monitor, StageClock& clock) const {
        Extent tile = settings.tile.value_or(default_gpu_tile);
        settings.limits.visibility_bytes =
            std::min<std::uint64_t>(settings.limits.visibility_bytes, usable_memory() / 2);
        for (;;) {
            settings.tile = tile;
            try {
                return build_and_render(scene, settings, monitor, clock);
            } catch (const Error& e) {
                const bool is_smallest =
                    tile.width <= least_tile_side && tile.height <= least_tile_side;
                if (e.code() != ErrorCode::out_of_memory || is_smallest) throw;
            }
            if (monitor != nullptr) monitor->contributions = monitor->gathers = 0;
            backend_.memory().trim();
            tile = {std::max(tile.width / 2, std::min(tile.width, least_tile_side)),
                    std::max(tile.height / 2, std::min(tile.height, least_tile_side))};
            settings.limits.visibility_bytes /= 2;
        }
    }

    /// Bytes of the GPU that are free, and those that are kept for this image.
    [[nodiscard]] std::uint64_t usable_memory() const {
        return free_memory(device_.ordinal) + backend_.memory().idle(MemoryKind::device);
    }

    [[nodiscard]] RenderResult build_and_render(const Scene& scene, const RenderSettings& settings,
                                                Monitor* monitor, StageClock& clock) const {
        cpu::TbbExecutor executor(settings.threads);
        const WorldGeometry geometry = [&] {
            const auto stage = clock.measure(&StageSeconds::geometry);
            return WorldGeometry(scene, settings.limits, executor);
        }();
        check_world(scene, settings.camera, geometry);
        RenderResult result =
            is_lambertian(scene)
                ? trace<Lambert>(scene, settings, geometry, executor, monitor, clock)
                : trace<CookTorrance>(scene, settings, geometry, executor, monitor, clock);
        count_triangles(geometry, result.statistics);
        return result;
    }

    template <Bsdf F>
    [[nodiscard]] RenderResult trace(const Scene& scene, const RenderSettings& settings,
                                     const WorldGeometry& geometry, cpu::TbbExecutor& executor,
                                     Monitor* monitor, StageClock& clock) const {
        CancellableExecutor cancellable(executor, monitor);
        using E = decltype(cancellable);
        // These two trace on the host, whatever the backend; luxels gather on the GPU.
        if (settings.integrator != Integrator::vpl) {
            const KdTreeScene engine = [&] {
                const auto stage = clock.measure(&StageSeconds::build);
                return KdTreeScene(geometry, executor);
            }();
            if (settings.integrator == Integrator::micro)
                return MicroRender<F, GatherScene<F>, E>(scene, settings, geometry,
                                                         GatherScene<F>(engine, backend_),
                                                         cancellable, monitor, clock)
                    .run();
            return PathRender<F, KdTreeScene, E>(scene, settings, geometry, engine, cancellable,
                                                 monitor, clock)
                .run();
        }
        const Structures structures = structures_of(scene, settings);
        const BackendEngineOptions options{
            scheduler_, structures.kd_tree, structures.shafts,
            std::min<std::uint64_t>(usable_memory() / 4, ChainPortions{}.bytes)};
        const GpuEngine<F> engine = [&] {
            const auto stage = clock.measure(&StageSeconds::upload);
            const auto make_tree = [&geometry, &executor] {
                return KdTree(geometry, KdTreeOptions::for_gpu(), executor);
            };
            return GpuEngine<F>(backend_, scene, geometry, executor, make_tree, options, clock);
        }();
        if (monitor != nullptr) monitor->check();
        // A GpuEngine lights bands itself; no scheduler of the host is ever opened.
        const auto none = [](E& loops, Monitor* m) { return sched::Cpu{loops, m}; };
        return TiledRender<F, GpuEngine<F>, E, decltype(none)>(scene, settings, geometry, engine,
                                                               cancellable, monitor, clock, none)
            .run();
    }

    const char* name_;
    BackendScheduler scheduler_;
    Device device_;
    Backend backend_;
};

}  // namespace

void add_to(Registry& registry) {
    Registry::Backend backend{
        BackendKind::cuda, "cuda", [] { static_cast<void>(select_device()); }, "rcvp", {}};
    backend.refuses = host_only;
    backend.is_present = [] { return versions().driver != 0; };
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
