// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/all_renderers.hpp"

namespace mir {

/// Adds the compiled renderers of GPUs: "rcvp" (default), "rc" and "os". No GPU has to be there;
/// Registry::make() says so when one is wanted. Defined in backends/cuda/src/, in builds that have
/// it.
void add_cuda_to(Registry& registry);

/// Appends the GPUs of this machine, or why there is none. Defined as add_cuda_to().
void append_cuda_devices(DeviceList& list);

}  // namespace mir
