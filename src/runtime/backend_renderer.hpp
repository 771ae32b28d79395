// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/renderer.hpp"
#include "runtime/backend_disc_gather.hpp"
#include "runtime/backend_frame.hpp"
#include "runtime/backend_structures.hpp"
#include "runtime/checked_render.hpp"
#include "runtime/render_on_host.hpp"
#include "runtime/render_vpls.hpp"
#include "runtime/traced_scenes.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace mir {

/// A Backend, and what a renderer wants to know of the machine behind it.
template <Backend M>
struct BackendMachine {
    M backend;                                    ///< where frames are made
    std::string name;                             ///< of the backend, as users write it
    std::string device;                           ///< make of the machine
    std::function<std::uint64_t()> usable_bytes;  ///< free, or kept for the next image
    std::function<void()> trim;                   ///< gives back what is kept
};

/// Renders on a backend. By VPLs in its memory (BackendFrame); paths are traced, and discs made, on
/// the host, where luxels gather from those on the backend. Tries again with smaller tiles and
/// bands while the machine has too little memory.
template <Backend M>
class BackendRenderer final : public Renderer {
 public:
    /// `name` is that of the scheduler.
    BackendRenderer(std::string name, BackendScheduler scheduler, BackendMachine<M> machine)
        : name_(std::move(name)), scheduler_(scheduler), machine_(std::move(machine)) {}

    RenderResult render(const Scene& scene, const RenderSettings& settings,
                        Monitor* monitor) const override {
        settings.validate();
        if (const std::string reason = reason_against(settings, backend_features); !reason.empty())
            throw Error(ErrorCode::unsupported, reason);
        // The fingerprint beside the machine's work: it takes as long as a stage.
        CheckedRender checked(scene, settings, monitor, std::launch::async);
        RenderResult result = render_in_memory(checked.placed(), settings);
        result.statistics.backend = machine_.name;
        result.statistics.device = machine_.device;
        result.statistics.scheduler = name_;
        return checked.complete(std::move(result));
    }

 private:
    /// Luxels scheduled together unless the settings say: enough to fill a large GPU.
    static constexpr Extent default_tile{1024, 1024};
    /// Smallest tile that running out of memory leads to.
    static constexpr std::uint32_t least_tile_side = 64;

    [[nodiscard]] RenderResult render_in_memory(const PlacedScene& placed,
                                                RenderSettings settings) const {
        Extent tile = settings.tile.value_or(default_tile);
        settings.limits.visibility_bytes =
            std::min<std::uint64_t>(settings.limits.visibility_bytes, machine_.usable_bytes() / 2);
        for (;;) {
            settings.tile = tile;
            try {
                return render(placed, settings);
            } catch (const Error& e) {
                const bool is_smallest =
                    tile.width <= least_tile_side && tile.height <= least_tile_side;
                if (e.code() != ErrorCode::out_of_memory || is_smallest) throw;
            }
            if (placed.monitor != nullptr)
                placed.monitor->contributions = placed.monitor->gathers = 0;
            machine_.trim();
            tile = {std::max(tile.width / 2, std::min(tile.width, least_tile_side)),
                    std::max(tile.height / 2, std::min(tile.height, least_tile_side))};
            settings.limits.visibility_bytes /= 2;
        }
    }

    [[nodiscard]] RenderResult render(const PlacedScene& placed,
                                      const RenderSettings& settings) const {
        const bool by_vpls = settings.integrator == Integrator::vpl;
        const BackendStructures structures =
            by_vpls ? structures_of(placed.geometry.is_masked(), settings) : tree_alone;
        const RenderSettings decided = with_light_sum(settings, backend_features);
        RenderJob job(placed, decided);
        RenderResult result = by_vpls ? render_there(job, structures) : render_here(job);
        result.statistics.acceleration = structures.name;
        return result;
    }

    [[nodiscard]] RenderResult render_there(RenderJob& job,
                                            const BackendStructures& structures) const {
        const BackendFrameOptions options{
            scheduler_, structures.kd_tree, structures.shafts,
            std::min<std::uint64_t>(machine_.usable_bytes() / 4,
                                    BackendFrameOptions{}.chain_bytes)};
        const std::unique_ptr<RenderFrame> frame = [&] {
            const auto stage = job.clock.measure(&StageSeconds::upload);
            return job.with_surfaces(
                [&]<Bsdf B>(const SurfaceTable<B>&) -> std::unique_ptr<RenderFrame> {
                    return std::make_unique<BackendFrame<M, B>>(
                        job, machine_.backend,
                        [&job] { return tree_for_backends(job.geometry, job.threads); }, options);
                });
        }();
        if (job.monitor != nullptr) job.monitor->check();
        return render_vpls(*frame);
    }

    [[nodiscard]] RenderResult render_here(RenderJob& job) const {
        const TracedScenePtr traced = [&] {
            const auto stage = job.clock.measure(&StageSeconds::build);
            return trace_by_kd_tree(job.geometry, job.threads);
        }();
        const std::unique_ptr<DiscGather> gather =
            job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>&) -> std::unique_ptr<DiscGather> {
                return std::make_unique<BackendDiscGather<M, B>>(machine_.backend);
            });
        return render_on_host(job, *traced, HostScheduler::cpu_blocks, gather.get());
    }

    std::string name_;
    BackendScheduler scheduler_;
    BackendMachine<M> machine_;
};

/// The schedulers of backends, and their names in the Registry.
inline constexpr std::array<std::pair<const char*, BackendScheduler>, 3> backend_schedulers{
    {{"os", BackendScheduler::os}, {"rc", BackendScheduler::rc}, {"rcvp", BackendScheduler::rcvp}}};

/// A backend for the Registry, with `kind` and the name that users write. Its renderers are made
/// over the machine that open() returns. `require` and `is_present` as of Registry::Backend.
template <class Open>
[[nodiscard]] Registry::Backend registered_backend(BackendKind kind, std::string name,
                                                   std::function<void()> require,
                                                   std::function<bool()> is_present, Open open) {
    using Machine = std::invoke_result_t<Open>;
    using M = decltype(Machine::backend);
    Registry::Backend backend{kind, std::move(name), std::move(require), "rcvp", {}};
    backend.refuses = [](const RenderSettings& s) { return reason_against(s, backend_features); };
    backend.is_present = std::move(is_present);
    for (const auto& [scheduler, how] : backend_schedulers)
        backend.schedulers.emplace(scheduler, [scheduler = scheduler, how = how, open] {
            return std::make_unique<BackendRenderer<M>>(scheduler, how, open());
        });
    return backend;
}

}  // namespace mir
