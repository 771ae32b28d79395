// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/renderer.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mir {

/// Adds every renderer that this build of mir::runtime holds, those of GPUs first. No device has to
/// be there.
void add_all_to(Registry& registry);

/// Adds the processor's renderers. "cpu-blocks" is the tuned path (default), "cpu" the plain loop
/// that is the oracle; "os", "rc" and "rcvp" are the paper's. RenderSettings::acceleration chooses
/// what they trace through.
void add_cpu_to(Registry& registry);

/// "Embree 3.13.5" or the like, and the vector instructions that loops will use.
std::string cpu_description();

/// A machine that this build could render on.
struct DeviceReport {
    std::string name;           ///< "cpu", "cuda:0", "cuda:1"
    std::string description;    ///< make, versions of libraries and drivers
    std::uint64_t memory = 0;   ///< bytes of its own memory; 0: that of the machine
    std::uint32_t threads = 0;  ///< of the processor; multiprocessors of a GPU
};

/// Present renderers, and a sentence for each built-in backend that cannot be used.
struct DeviceList {
    std::vector<DeviceReport> devices;     ///< the processor first
    std::vector<std::string> unavailable;  ///< "cuda: there is no driver ..."
};

/// Looks for devices. Never throws for those that are missing.
DeviceList list_devices();

}  // namespace mir
