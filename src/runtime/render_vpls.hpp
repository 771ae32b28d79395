// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

namespace mir {

/// Largest geometry term of the VPLs of a render, m^-2, as the settings want it. The largest number
/// for none. Goes to the statistics.
[[nodiscard]] float choose_bound(RenderFrame& frame);

/// Renders by VPLs of the sampler that the settings name. Normalises them where their sampler needs
/// it, then goes through the image in bands of luxel rows, so that memory does not grow with the
/// number of luxels. To be called once for a frame.
/// @throws Error(unsupported) when the frame lacks what the settings want; what its stages throw.
[[nodiscard]] RenderResult render_vpls(RenderFrame& frame);

/// The same by VPLs that were sampled under `bound`, of choose_bound().
[[nodiscard]] RenderResult render_vpls(RenderFrame& frame, const SampledVpls& sampled, float bound);

/// Places VPLs and makes their intensities, as render_vpls() does, without a picture. `bound` is of
/// choose_bound(). To be called once for a frame, and nothing else.
[[nodiscard]] VplList placed_vpls(RenderFrame& frame, float bound);

}  // namespace mir
