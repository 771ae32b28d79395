// SPDX-License-Identifier: MIT
#include "mir/core/instruction_set.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "runtime/checked_render.hpp"
#include "runtime/host_frame.hpp"
#include "runtime/host_tracing.hpp"
#include "runtime/render_on_host.hpp"

namespace mir {
namespace {

class CpuRenderer : public Renderer {
 public:
    CpuRenderer(std::string_view name, HostScheduler scheduler)
        : name_(name), scheduler_(scheduler) {}

    RenderResult render(const Scene& scene, const RenderSettings& settings,
                        Monitor* monitor) const override {
        return render(scene, settings, monitor, nullptr);
    }
    RenderResult render_share(const Scene& scene, const RenderSettings& settings, Monitor* monitor,
                              PictureShare& share) const override {
        return render(scene, settings, monitor, &share);
    }

 private:
    RenderResult render(const Scene& scene, const RenderSettings& wanted, Monitor* monitor,
                        PictureShare* share) const {
        const RenderSettings settings = with_light_sum(wanted);
        CheckedRender checked(scene, settings, monitor, std::launch::deferred, share);
        const HostTracing tracing = trace_on_host(checked.placed(), settings);
        RenderJob job(checked.placed(), settings);
        job.share = share;
        RenderResult result = render_on_host(job, *tracing.scene, scheduler_);
        result.statistics.backend = "cpu";
        result.statistics.scheduler = name_;
        result.statistics.acceleration = tracing.name;
        return checked.complete(std::move(result));
    }

    std::string name_;
    HostScheduler scheduler_;
};

}  // namespace

void add_cpu_to(Registry& registry) {
    Registry::Backend backend{BackendKind::cpu, "cpu", [] {}, "cpu-blocks", {}};
    backend.refuses = reason_against_tracing;
    for (const auto& [name, kind] : host_schedulers)
        backend.schedulers.emplace(
            name, [name = name, kind = kind] { return std::make_unique<CpuRenderer>(name, kind); });
    registry.add(std::move(backend));
}

std::string cpu_description() {
    const char* sets[] = {"baseline", "AVX2", "AVX-512"};
    const EmbreeTracing* embree = embree_tracing();
    return (embree != nullptr ? embree->version : "no Embree") + ", " +
           std::string(sets[static_cast<int>(best_instruction_set())]) + " loops";
}

}  // namespace mir
