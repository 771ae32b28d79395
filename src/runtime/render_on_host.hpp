// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/disc_gather.hpp"
#include "runtime/host_schedulers.hpp"
#include "runtime/render_job.hpp"
#include "runtime/traced_scene.hpp"

namespace mir {

/// Renders with the integrator of the settings in the host's memory. Luxels gather from discs on
/// `machine`, if it is not null.
/// @throws What render_vpls(), render_paths() and render_discs() throw.
[[nodiscard]] RenderResult render_on_host(RenderJob& job, const TracedScene& traced,
                                          HostScheduler scheduler, DiscGather* machine = nullptr);

}  // namespace mir
