// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/host_schedulers.hpp"
#include "runtime/render_frame.hpp"
#include "runtime/traced_scene.hpp"

#include <memory>

namespace mir {

/// A frame in the host's memory (HostBand, HostLayer). VPLs light luxels in the order of a
/// scheduler. What is passed in must outlive it.
[[nodiscard]] std::unique_ptr<RenderFrame> host_frame(RenderJob& job, const TracedScene& traced,
                                                      HostScheduler scheduler);

}  // namespace mir
