// SPDX-License-Identifier: MIT
#include "mir/cuda/backend.hpp"
#include "mir/cuda/register.hpp"
#include "runtime/backend_renderer.hpp"

namespace mir::cuda {
namespace {

BackendMachine<Backend> open_first_gpu() {
    const Device device = select_device();
    const Backend backend(device);
    const auto usable_bytes = [backend] {
        return free_memory(backend.device()) + backend.memory().idle(MemoryKind::device);
    };
    // Wakes the GPU, which takes longer than a picture and would count as part of the first.
    static_cast<void>(free_memory(device.ordinal));
    return {backend, "cuda", device.name, usable_bytes, [backend] { backend.memory().trim(); }};
}

}  // namespace

void add_to(Registry& registry) {
    registry.add(registered_backend(
        BackendKind::cuda, "cuda", [] { static_cast<void>(select_device()); },
        [] { return versions().driver != 0; }, open_first_gpu));
}

void append_devices(DeviceList& list) {
    try {
        for (const Device& d : devices()) {
            const std::string name = "cuda:" + std::to_string(d.ordinal);
            if (is_supported(d))
                list.devices.push_back({name,
                                        d.name + ", compute capability " + capability_text(d) +
                                            ", CUDA " + version_text(versions().runtime) +
                                            ", driver for CUDA " + version_text(versions().driver),
                                        d.memory_bytes, d.multiprocessors});
            else
                list.unavailable.push_back(name + ": " + d.name +
                                           " is too old (its compute capability is " +
                                           capability_text(d) + ", kernels need 7.5)");
        }
    } catch (const Error& e) {
        list.unavailable.push_back(std::string("cuda: ") + e.what());
    }
}

}  // namespace mir::cuda
