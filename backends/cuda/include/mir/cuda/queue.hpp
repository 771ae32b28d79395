// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/buffer.hpp"
#include "mir/cuda/event.hpp"

#include <cstdint>
#include <span>

namespace mir::cuda {

/// Work of one device in order: a CUDA stream, its own or the caller's. Own streams do not wait
/// for the legacy default stream. Everything returns before it is done, except copies from and
/// to host memory that is not pinned. The end waits for the work. Move-only; one thread at a
/// time.
class Queue {
 public:
    /// @throws Error(device), Error(no_device)
    explicit Queue(int device) : device_(device), is_own_(true) {
        const ActiveDevice active(device_);
        check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "making a stream");
    }
    /// Work goes to the caller's stream of that device, behind what is there already. The stream
    /// must outlive the queue, which does not destroy it.
    Queue(int device, cudaStream_t stream) : device_(device), stream_(stream) {}

    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;
    /// `other` is no queue afterwards: it may end or be assigned to.
    Queue(Queue&& other) noexcept { swap(other); }
    /// Waits for the work of what this was; `other` is no queue afterwards.
    Queue& operator=(Queue&& other) noexcept {
        Queue moved(std::move(other));
        swap(moved);
        return *this;
    }
    ~Queue() {
        if (device_ < 0) return;
        release_on(device_, [this] {
            static_cast<void>(cudaStreamSynchronize(stream_));
            if (is_own_) static_cast<void>(cudaStreamDestroy(stream_));
        });
    }

    /// Copies all of `from` to the front of `to`.
    /// @throws Error(invalid_argument) when it does not fit; Error(device)
    template <class T>
    void upload(std::span<const T> from, Buffer<T>& to) {
        expects(from.size() <= to.size(), "a copy is larger than the buffer it goes to");
        copy(to.data(), from.data(), from.size_bytes(), cudaMemcpyHostToDevice,
             "a copy to the GPU");
    }

    /// Fills `to` from the front of `from`.
    /// @throws Error(invalid_argument) when there is not that much; Error(device)
    template <class T>
    void download(const Buffer<T>& from, std::span<T> to) {
        expects(to.size() <= from.size(), "a copy is larger than the buffer it comes from");
        copy(to.data(), from.data(), to.size_bytes(), cudaMemcpyDeviceToHost,
             "a copy from the GPU");
    }

    /// Sets every byte of `buffer` to zero.
    /// @throws Error(device)
    template <class T>
    void clear(Buffer<T>& buffer) {
        if (buffer.size() == 0) return;
        const ActiveDevice active(device_);
        check(cudaMemsetAsync(buffer.data(), 0, buffer.size() * sizeof(T), stream_),
              "clearing memory of the GPU");
    }

    /// Calls kernel(i) on the device, once for each i in [0, n). 256 neighbouring i are one thread
    /// block. Defined in mir/cuda/launch.cuh, for files that nvcc compiles.
    /// @throws Error(device) when the kernel cannot be started.
    template <class Kernel>
    void for_each(std::uint32_t n, const Kernel& kernel);

    /// Bit i % 32 of words[(i / 32) columns + j] becomes kernel(kernel.row(i), j). Each word is
    /// written once. Defined in mir/cuda/launch.cuh, for files that nvcc compiles.
    /// @throws Error(invalid_argument) unless rows is a multiple of 32; Error(device)
    template <class Kernel>
    void fill_bits(std::uint32_t rows, std::uint32_t columns, const Kernel& kernel,
                   std::uint32_t* words);

    /// Calls kernel(group, i, space) on the device, once for each i in [0, n). A warp makes each
    /// call, with a Kernel::Workspace in shared memory. Defined in mir/cuda/launch.cuh, for files
    /// that nvcc compiles.
    /// @throws Error(device) when the kernel cannot be started.
    template <class Kernel>
    void for_each_group(std::uint32_t n, const Kernel& kernel);

    /// Sorts pairs by their keys, stably, by radix. Defined in mir/cuda/sort.cuh, for files that
    /// nvcc compiles. An error that the caller's CUDA code has not read is forgotten.
    /// @throws Error(invalid_argument) when the scratch is smaller than scratch_bytes(n);
    ///         Error(device)
    void sort_by_key(std::uint32_t n, std::uint64_t* keys, std::uint32_t* values,
                     Buffer<std::byte>& scratch);

    /// sums[i] becomes the sum of the first i words. Otherwise like sort_by_key().
    void sum_before(std::uint32_t n, const std::uint32_t* from, std::uint32_t* sums,
                    Buffer<std::byte>& scratch);

    /// What either needs for `n` elements or fewer. Defined in mir/cuda/sort.cuh.
    /// @throws Error(device)
    [[nodiscard]] std::size_t scratch_bytes(std::uint32_t n) const;

    /// The point behind all work given so far.
    /// @throws Error(device)
    [[nodiscard]] Event record() {
        Event event(device_);
        const ActiveDevice active(device_);
        check(cudaEventRecord(event.handle(), stream_), "recording an event");
        return event;
    }

    /// Holds back what follows, not the caller, until the event has passed.
    /// @throws Error(device)
    void wait(const Event& event) {
        const ActiveDevice active(device_);
        check(cudaStreamWaitEvent(stream_, event.handle(), 0), "waiting for an event");
    }

    /// Waits until all work given so far is done.
    /// @throws Error(device) when some of it failed.
    void sync() const {
        const ActiveDevice active(device_);
        check(cudaStreamSynchronize(stream_), "work on the GPU");
    }

    /// CUDA's handle: the caller's stream, or one that this object destroys.
    [[nodiscard]] cudaStream_t stream() const { return stream_; }
    /// Ordinal of its device; -1 when moved from.
    [[nodiscard]] int device() const { return device_; }

 private:
    void copy(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind,
              const char* doing) {
        if (bytes == 0) return;
        const ActiveDevice active(device_);
        check(cudaMemcpyAsync(to, from, bytes, kind, stream_), doing);
    }
    void swap(Queue& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(stream_, other.stream_);
        std::swap(is_own_, other.is_own_);
    }

    int device_ = -1;  ///< none when moved from
    cudaStream_t stream_ = nullptr;
    bool is_own_ = false;
};

}  // namespace mir::cuda
