// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/cuda/buffer.hpp"
#include "mir/cuda/device.hpp"
#include "mir/cuda/event.hpp"
#include "mir/cuda/pinned_buffer.hpp"
#include "mir/cuda/queue.hpp"

#include <optional>

namespace mir::cuda {

/// A GPU as a Backend: a handle that is cheap to copy. Copies share memory that was given back.
/// Several may live in one process, for one GPU or many, in one thread or many: each call makes its
/// GPU the thread's current one and puts the former back. Thread-safe; a queue belongs to one
/// thread at a time.
///
/// This header compiles without nvcc. Files that start kernels include mir/cuda/backend.cuh.
///
/// After a failure of a kernel (Error(device) that says so) CUDA refuses all work of the process:
/// other backends go on, and a new process can use the GPU again. After any other Error the next
/// image can be made.
class Backend {
 public:
    static constexpr Space space = Space::device;  ///< kernels read memory of the GPU
    /// Memory of the GPU.
    template <class T>
    using Buffer = cuda::Buffer<T>;
    /// Pinned memory of the host.
    template <class T>
    using HostBuffer = PinnedBuffer<T>;
    /// What Queue::record() gives.
    using Event = cuda::Event;
    /// A stream of the GPU.
    using Queue = cuda::Queue;

    /// The backend of a device that select_device() gave. `hook` may refuse allocations.
    /// @throws Error(no_device), Error(device), Error(out_of_memory) when the GPU cannot be used.
    explicit Backend(const Device& device, AllocationHook hook = {})
        : device_(device.ordinal),
          memory_(std::make_shared<Memory>(device.ordinal, std::move(hook))) {
        const ActiveDevice creates_the_context(device_);
    }

    /// The same backend with all its work in the caller's stream of that GPU. It comes behind what
    /// is there already. One stream keeps one order: copies no longer run beside kernels. The
    /// stream must outlive what the backend hands out.
    [[nodiscard]] Backend on(cudaStream_t stream) const {
        Backend other = *this;
        other.stream_ = stream;
        return other;
    }

    /// @throws Error(device)
    [[nodiscard]] Queue queue() const {
        return stream_.has_value() ? Queue(device_, *stream_) : Queue(device_);
    }
    /// @throws Error(out_of_memory)
    template <class T>
    [[nodiscard]] Buffer<T> buffer(std::size_t size) const {
        return {memory_, size};
    }
    /// @throws Error(out_of_memory)
    template <class T>
    [[nodiscard]] HostBuffer<T> host_buffer(std::size_t size) const {
        return {memory_, size};
    }

    /// Allocator of pinned host memory for containers, such as BlockedGBuffer's.
    template <class T>
    [[nodiscard]] PinnedAllocator<T> pinned() const {
        return PinnedAllocator<T>(memory_);
    }

    /// What its buffers take.
    [[nodiscard]] Memory& memory() const { return *memory_; }
    /// Ordinal of its device.
    [[nodiscard]] int device() const { return device_; }

 private:
    int device_ = 0;
    std::shared_ptr<Memory> memory_;
    std::optional<cudaStream_t> stream_ = std::nullopt;
};

static_assert(mir::Backend<Backend>);

}  // namespace mir::cuda
