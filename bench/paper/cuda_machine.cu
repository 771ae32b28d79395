// SPDX-License-Identifier: MIT
#include "backend_machine.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/cuda/sort.cuh"

namespace mirpaper {

/// Moments of a CUDA stream are events.
template <>
struct Marks<mir::cuda::Backend> {
    using Mark = mir::cuda::Event;

    static Mark mark(mir::cuda::Queue& queue) { return queue.record(); }
    static double seconds(const Mark& from, const Mark& to) { return seconds_between(from, to); }
};

std::unique_ptr<Machine> make_cuda_machine(Executor& executor) {
    using B = mir::cuda::Backend;
    using Alloc = mir::cuda::PinnedAllocator<std::uint32_t>;
    const mir::cuda::Device device = mir::cuda::select_device();
    const mir::cuda::Versions versions = mir::cuda::versions();
    const B backend(device);
    return std::make_unique<BackendMachine<B, Alloc>>(
        backend, backend.pinned<std::uint32_t>(), "cuda",
        device.name + ", compute capability " + capability_text(device) + ", CUDA " +
            mir::cuda::version_text(versions.runtime) + ", driver for CUDA " +
            mir::cuda::version_text(versions.driver),
        executor);
}

}  // namespace mirpaper
