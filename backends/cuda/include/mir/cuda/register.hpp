// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/all_renderers.hpp"

namespace mir::cuda {

/// Adds the compiled renderers of the first GPU: "rcvp" (default), "rc" and "os". They trace
/// through the hierarchy or the kd-tree (RenderSettings::acceleration). No GPU has to be there;
/// Registry::make() says so when one is wanted.
void add_to(Registry& registry);

/// Appends the GPUs of this machine, or why there is none.
void append_devices(DeviceList& list);

}  // namespace mir::cuda
