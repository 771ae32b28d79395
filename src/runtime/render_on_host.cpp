// SPDX-License-Identifier: MIT
#include "runtime/render_on_host.hpp"

#include "runtime/host_frame.hpp"
#include "runtime/render_discs.hpp"
#include "runtime/render_paths.hpp"
#include "runtime/render_vpls.hpp"
#include "runtime/shared_frame.hpp"

mir::RenderResult mir::render_on_host(RenderJob& job, const TracedScene& traced,
                                      HostScheduler scheduler, DiscGather* machine) {
    const std::unique_ptr<RenderFrame> frame = shared_out(job, host_frame(job, traced, scheduler));
    switch (job.settings.integrator) {
        case Integrator::path:
            return render_paths(*frame);
        case Integrator::micro:
            return render_discs(*frame, machine);
        case Integrator::vpl:
            break;
    }
    return render_vpls(*frame);
}
