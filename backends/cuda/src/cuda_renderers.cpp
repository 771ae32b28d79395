// SPDX-License-Identifier: MIT
#include "runtime/cuda_renderers.hpp"

#include "mir/cuda/backend.hpp"
#include "runtime/backend_renderer.hpp"

namespace mir {
namespace {

BackendMachine<cuda::Backend> open_gpu(std::uint32_t number) {
    const cuda::Device device = cuda::select_device(static_cast<int>(number));
    const cuda::Backend backend(device);
    const auto usable_bytes = [backend] {
        return cuda::free_memory(backend.device()) +
               backend.memory().idle(cuda::MemoryKind::device);
    };
    // Wakes the GPU, which takes longer than a picture and would count as part of the first.
    static_cast<void>(cuda::free_memory(device.ordinal));
    return {backend, "cuda", device.name, usable_bytes, [backend] { backend.memory().trim(); }};
}

std::vector<std::uint32_t> usable_gpus() {
    std::vector<std::uint32_t> numbers;
    for (const cuda::Device& device : cuda::devices())
        if (cuda::is_supported(device))
            numbers.push_back(static_cast<std::uint32_t>(device.ordinal));
    return numbers;
}

}  // namespace

void add_cuda_to(Registry& registry) {
    registry.add(registered_backend<cuda::Backend>(
        BackendKind::cuda, "cuda", [] { static_cast<void>(cuda::select_device()); },
        [] { return cuda::versions().driver != 0; }, open_gpu, usable_gpus));
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
