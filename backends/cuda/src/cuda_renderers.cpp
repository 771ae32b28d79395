// SPDX-License-Identifier: MIT
#include "runtime/cuda_renderers.hpp"

#include "mir/cuda/backend.hpp"
#include "runtime/backend_renderer.hpp"

namespace mir {
namespace {

BackendMachine<cuda::Backend> open_first_gpu() {
    const cuda::Device device = cuda::select_device();
    const cuda::Backend backend(device);
    const auto usable_bytes = [backend] {
        return cuda::free_memory(backend.device()) +
               backend.memory().idle(cuda::MemoryKind::device);
    };
    // Wakes the GPU, which takes longer than a picture and would count as part of the first.
    static_cast<void>(cuda::free_memory(device.ordinal));
    return {backend, "cuda", device.name, usable_bytes, [backend] { backend.memory().trim(); }};
}

}  // namespace

void add_cuda_to(Registry& registry) {
    registry.add(registered_backend(
        BackendKind::cuda, "cuda", [] { static_cast<void>(cuda::select_device()); },
        [] { return cuda::versions().driver != 0; }, open_first_gpu));
}

void append_cuda_devices(DeviceList& list) {
    try {
        for (const cuda::Device& d : cuda::devices()) {
            const std::string name = "cuda:" + std::to_string(d.ordinal);
            if (cuda::is_supported(d))
                list.devices.push_back(
                    {name,
                     d.name + ", compute capability " + cuda::capability_text(d) + ", CUDA " +
                         cuda::version_text(cuda::versions().runtime) + ", driver for CUDA " +
                         cuda::version_text(cuda::versions().driver),
                     d.memory_bytes, d.multiprocessors});
            else
                list.unavailable.push_back(name + ": " + d.name +
                                           " is too old (its compute capability is " +
                                           cuda::capability_text(d) + ", kernels need 7.5)");
        }
    } catch (const Error& e) {
        list.unavailable.push_back(std::string("cuda: ") + e.what());
    }
}

}  // namespace mir
