// SPDX-License-Identifier: MIT
#include "mir/runtime/all_renderers.hpp"

#ifdef MIR_RUNTIME_HAS_CUDA
#include "runtime/cuda_renderers.hpp"
#endif

#include <thread>

namespace mir {

void add_all_to(Registry& registry) {
#ifdef MIR_RUNTIME_HAS_CUDA
    add_cuda_to(registry);
#endif
    add_cpu_to(registry);
}

DeviceList list_devices() {
    DeviceList list;
    list.devices.push_back({"cpu", cpu_description(), 0, std::thread::hardware_concurrency()});
#ifdef MIR_RUNTIME_HAS_CUDA
    append_cuda_devices(list);
#else
    list.unavailable.emplace_back("cuda: this build was configured without it");
#endif
    return list;
}

}  // namespace mir
