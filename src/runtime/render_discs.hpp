// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/disc_gather.hpp"
#include "runtime/render_frame.hpp"

namespace mir {

/// Renders with indirect light gathered from a hierarchy of discs. Luxels, direct light, film and
/// layers are those of render_vpls(). Luxels gather on `machine`, if it is not null, else on the
/// frame's executor. How far the gathered light lies from that of paths is measured first, and the
/// correction made (GatherCheck). To be called once for a frame of host_frame().
/// @throws Error(cancelled), Error(limit_exceeded) when discs or their links pass the limits, and
///         what its stages throw.
[[nodiscard]] RenderResult render_discs(RenderFrame& frame, DiscGather* machine = nullptr);

}  // namespace mir
