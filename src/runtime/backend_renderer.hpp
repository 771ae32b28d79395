// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/renderer.hpp"
#include "runtime/backend_disc_gather.hpp"
#include "runtime/backend_frame.hpp"
#include "runtime/backend_machines.hpp"
#include "runtime/backend_structures.hpp"
#include "runtime/checked_render.hpp"
#include "runtime/render_on_host.hpp"
#include "runtime/render_vpls.hpp"
#include "runtime/shared_frame.hpp"
#include "runtime/shared_tree.hpp"
#include "runtime/side_threads.hpp"
#include "runtime/split_frame.hpp"
#include "runtime/traced_scenes.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

namespace mir {

/// Renders on machines of a backend. By VPLs in their memory (BackendFrame), which share the image
/// where several are asked for (SplitFrame); paths are traced, and discs made, on the host, where
/// luxels gather from those on the first machine. Tries again with smaller tiles and bands while a
/// machine has too little memory.
template <Backend M>
class BackendRenderer final : public Renderer {
 public:
    /// `name` is that of the scheduler; the rest as of BackendMachines. The machines are kept from
    /// image to image.
    BackendRenderer(std::string name, BackendScheduler scheduler, OpenMachine<M> open,
                    UsableMachines usable)
        : name_(std::move(name)),
          scheduler_(scheduler),
          machines_(std::move(open), std::move(usable)) {}

    RenderResult render(const Scene& scene, const RenderSettings& settings,
                        Monitor* monitor) const override {
        return render(scene, settings, monitor, nullptr);
    }
    RenderResult render_share(const Scene& scene, const RenderSettings& settings, Monitor* monitor,
                              PictureShare& share) const override {
        return render(scene, settings, monitor, &share);
    }

 private:
    using Machines = std::vector<BackendMachine<M>>;

    [[nodiscard]] RenderResult render(const Scene& scene, const RenderSettings& settings,
                                      Monitor* monitor, PictureShare* share) const {
        settings.validate();
        if (const std::string reason = reason_against(settings, backend_features); !reason.empty())
            throw Error(ErrorCode::unsupported, reason);
        const Machines machines = machines_.chosen(settings.devices);
        // The fingerprint beside the machine's work: it takes as long as a stage.
        CheckedRender checked(scene, settings, monitor, std::launch::async, share);
        RenderResult result = render_in_memory(checked.placed(), settings, machines, share);
        result.statistics.backend = machines.front().name;
        for (const auto& machine : machines)
            result.statistics.device +=
                (result.statistics.device.empty() ? "" : ", ") + machine.device;
        result.statistics.scheduler = name_;
        return checked.complete(std::move(result));
    }

    /// Luxels scheduled together unless the settings say: enough to fill a large GPU.
    static constexpr Extent default_tile{1024, 1024};
    /// Smallest tile that running out of memory leads to.
    static constexpr std::uint32_t least_tile_side = 64;

    /// Of the machine that has least.
    [[nodiscard]] static std::uint64_t usable_bytes(const Machines& machines) {
        std::uint64_t least = machines.front().usable_bytes();
        for (const auto& machine : machines) least = std::min(least, machine.usable_bytes());
        return least;
    }

    [[nodiscard]] RenderResult render_in_memory(const PlacedScene& placed, RenderSettings settings,
                                                const Machines& machines,
                                                PictureShare* share) const {
        Extent tile = settings.tile.value_or(default_tile);
        settings.limits.visibility_bytes =
            std::min<std::uint64_t>(settings.limits.visibility_bytes, usable_bytes(machines) / 2);
        for (;;) {
            settings.tile = tile;
            try {
                return render(placed, settings, machines, share);
            } catch (const Error& e) {
                const bool is_smallest =
                    tile.width <= least_tile_side && tile.height <= least_tile_side;
                // Others count the loops of a shared picture: one that began again would wait for
                // them for ever.
                const bool is_shared = share != nullptr;
                if (e.code() != ErrorCode::out_of_memory || is_smallest || is_shared) throw;
            }
            if (placed.monitor != nullptr)
                placed.monitor->contributions = placed.monitor->gathers = 0;
            for (const auto& machine : machines) machine.trim();
            tile = {std::max(tile.width / 2, std::min(tile.width, least_tile_side)),
                    std::max(tile.height / 2, std::min(tile.height, least_tile_side))};
            settings.limits.visibility_bytes /= 2;
        }
    }

    [[nodiscard]] RenderResult render(const PlacedScene& placed, const RenderSettings& settings,
                                      const Machines& machines, PictureShare* share) const {
        const bool by_vpls = settings.integrator == Integrator::vpl;
        const BackendStructures structures =
            by_vpls ? structures_of(placed.geometry.is_opaque(), settings) : tree_alone;
        const RenderSettings decided = with_light_sum(settings);
        RenderJob job(placed, decided);
        job.share = share;
        RenderResult result =
            by_vpls ? render_there(job, structures, machines) : render_here(job, machines.front());
        result.statistics.acceleration = structures.name;
        return result;
    }

    [[nodiscard]] RenderResult render_there(RenderJob& job, const BackendStructures& structures,
                                            const Machines& machines) const {
        const BackendFrameOptions options{
            scheduler_, structures.kd_tree, structures.shafts,
            std::min<std::uint64_t>(usable_bytes(machines) / 4, BackendFrameOptions{}.chain_bytes)};
        SharedTree tree(job);
        std::vector<std::unique_ptr<RenderFrame>> frames(machines.size());
        {
            const auto stage = job.clock.measure(&StageSeconds::upload);
            on_side_threads(frames.size(), [&](std::size_t k) {
                frames[k] = frame_on(machines[k], job, options, tree);
            });
        }
        if (job.monitor != nullptr) job.monitor->check();
        std::unique_ptr<RenderFrame> frame =
            frames.size() == 1 ? std::move(frames.front())
                               : std::make_unique<SplitFrame>(job, std::move(frames));
        return render_vpls(*shared_out(job, std::move(frame)));
    }

    [[nodiscard]] static std::unique_ptr<RenderFrame> frame_on(const BackendMachine<M>& machine,
                                                               RenderJob& job,
                                                               const BackendFrameOptions& options,
                                                               SharedTree& tree) {
        return job.with_surfaces(
            [&]<Bsdf B>(const SurfaceTable<B>&) -> std::unique_ptr<RenderFrame> {
                return std::make_unique<BackendFrame<M, B>>(
                    job, machine.backend, [&tree] { return tree.get(); }, options);
            });
    }

    [[nodiscard]] static RenderResult render_here(RenderJob& job,
                                                  const BackendMachine<M>& machine) {
        const TracedScenePtr traced = [&] {
            const auto stage = job.clock.measure(&StageSeconds::build);
            return trace_by_kd_tree(job.geometry, job.threads);
        }();
        const std::unique_ptr<DiscGather> gather =
            job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>&) -> std::unique_ptr<DiscGather> {
                return std::make_unique<BackendDiscGather<M, B>>(machine.backend);
            });
        return render_on_host(job, *traced, HostScheduler::cpu_blocks, gather.get());
    }

    std::string name_;
    BackendScheduler scheduler_;
    mutable BackendMachines<M> machines_;
};

/// The schedulers of backends, and their names in the Registry.
inline constexpr std::array<std::pair<const char*, BackendScheduler>, 3> backend_schedulers{
    {{"os", BackendScheduler::os}, {"rc", BackendScheduler::rc}, {"rcvp", BackendScheduler::rcvp}}};

/// A backend for the Registry, with `kind` and the name that users write. Its renderers open
/// machines as BackendMachines does. `require` and `is_present` as of Registry::Backend.
template <Backend M>
[[nodiscard]] Registry::Backend registered_backend(BackendKind kind, std::string name,
                                                   std::function<void()> require,
                                                   std::function<bool()> is_present,
                                                   OpenMachine<M> open, UsableMachines usable) {
    Registry::Backend backend{kind, std::move(name), std::move(require), "rcvp", {}};
    backend.refuses = [](const RenderSettings& s) { return reason_against(s, backend_features); };
    backend.is_present = std::move(is_present);
    for (const auto& [scheduler, how] : backend_schedulers)
        backend.schedulers.emplace(scheduler, [scheduler = scheduler, how = how, open, usable] {
            return std::make_unique<BackendRenderer<M>>(scheduler, how, open, usable);
        });
    return backend;
}

}  // namespace mir
