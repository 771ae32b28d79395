// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

namespace mir {

/// Noise of direct light in a pixel by `samples` of each luxel. At two thousand places spread over
/// the image: the standard deviation over the light itself, root mean square over the places, 0 to
/// 1.4. It is 0 where all of it is summed exactly or where there is none; pixels much darker than
/// the mean weigh less. By rays of the host. Bits depend on scene, settings and seed alone.
[[nodiscard]] double direct_noise(RenderFrame& frame, DirectSamples samples);

}  // namespace mir
