// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

namespace mir {

/// Renders by the reference path tracer. Luxels, film and layers are those of render_vpls(), so
/// that the two results compare layer by layer. To be called once for a frame of host_frame().
/// @throws Error(invalid_argument) for options out of range, and what its stages throw.
[[nodiscard]] RenderResult render_paths(RenderFrame& frame);

}  // namespace mir
