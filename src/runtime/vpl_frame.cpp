// SPDX-License-Identifier: MIT
#include "mir/runtime/vpl_frame.hpp"

#include "runtime/checked_render.hpp"
#include "runtime/host_frame.hpp"
#include "runtime/host_tracing.hpp"
#include "runtime/render_vpls.hpp"

#include <algorithm>

namespace mir {
namespace {

HostScheduler scheduler_of(const RenderSettings& settings) {
    if (settings.scheduler.empty()) return HostScheduler::cpu_blocks;
    const auto found =
        std::find_if(host_schedulers.begin(), host_schedulers.end(),
                     [&](const auto& named) { return named.first == settings.scheduler; });
    if (found == host_schedulers.end())
        throw Error(ErrorCode::unsupported, "the processor has no scheduler '" +
                                                settings.scheduler +
                                                "'; leave RenderSettings::scheduler empty");
    return found->second;
}

}  // namespace

struct VplFrame::Parts {
    Parts(const Scene& scene, RenderSettings wanted, Monitor* monitor)
        : settings(with_light_sum(std::move(wanted))),
          checked(scene, settings, monitor, std::launch::deferred, nullptr),
          tracing(trace_on_host(checked.placed(), settings)),
          job(checked.placed(), settings),
          scheduler(scheduler_of(settings)),
          frame(host_frame(job, *tracing.scene, scheduler)),
          bound(choose_bound(*frame)) {}

    const RenderSettings settings;
    CheckedRender checked;
    HostTracing tracing;
    RenderJob job;
    HostScheduler scheduler;
    std::unique_ptr<RenderFrame> frame;
    float bound;
};

VplFrame::VplFrame(const Scene& scene, const RenderSettings& settings, Monitor* monitor)
    : parts_(std::make_unique<Parts>(scene, settings, monitor)) {}

VplFrame::~VplFrame() = default;

const WorldGeometry& VplFrame::geometry() const { return parts_->job.geometry; }
const LightTable& VplFrame::lights() const { return parts_->job.lights; }
AnyRayCaster VplFrame::ray_caster() const { return parts_->frame->rays().ray_caster(); }
AnyVisibility VplFrame::visibility() const { return parts_->frame->rays().visibility(); }
float VplFrame::bound() const { return parts_->bound; }
VplList VplFrame::place_vpls() {
    parts_->job.clock.follow_this_thread();
    return placed_vpls(*parts_->frame, parts_->bound);
}
AnyExecutor& VplFrame::executor() { return parts_->job.executor; }

RenderResult render_vpls(VplFrame& frame, const SampledVpls& sampled) {
    VplFrame::Parts& parts = *frame.parts_;
    parts.job.clock.follow_this_thread();
    RenderResult result = render_vpls(*parts.frame, sampled, parts.bound);
    RenderStatistics& s = result.statistics;
    s.backend = "cpu";
    s.acceleration = parts.tracing.name;
    for (const auto& [name, kind] : host_schedulers)
        if (kind == parts.scheduler) s.scheduler = name;
    return parts.checked.complete(std::move(result));
}

}  // namespace mir
