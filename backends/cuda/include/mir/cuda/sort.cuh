// SPDX-License-Identifier: MIT
#pragma once

// Sorting and sums of mir::cuda::Queue, by CUB, which comes with CUDA. A header of its own: files
// without them need not wait for it.
#include "mir/cuda/queue.hpp"

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

#include <algorithm>

namespace mir::cuda {

namespace detail {

/// Where sort_by_key() keeps things in its scratch, bytes. CUB moves pairs to and fro between two
/// places; its own notes lie behind the second.
struct SortScratch {
    std::size_t values = 0;
    std::size_t notes = 0;
    std::size_t notes_size = 0;

    explicit SortScratch(std::uint32_t n)
        : values(aligned(n * sizeof(std::uint64_t))),
          notes(values + aligned(n * sizeof(std::uint32_t))) {
        cub::DoubleBuffer<std::uint64_t> keys;
        cub::DoubleBuffer<std::uint32_t> pairs;
        check(cub::DeviceRadixSort::SortPairs(nullptr, notes_size, keys, pairs, n),
              "asking for the room to sort");
    }

    [[nodiscard]] std::size_t size() const { return notes + notes_size; }

 private:
    static std::size_t aligned(std::size_t bytes) { return (bytes + 255) / 256 * 256; }
};

inline std::size_t sum_scratch(std::uint32_t n) {
    std::size_t bytes = 0;
    std::uint32_t* const none = nullptr;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, none, none, n),
          "asking for the room to add up");
    return bytes;
}

/// Reads what errors others left first, because CUB takes them for its own.
inline void forget_errors_of_others() { static_cast<void>(cudaGetLastError()); }

/// Copies what CUB left at the second place.
template <class T>
void bring_home(const T* from, T* home, std::uint32_t n, cudaStream_t stream) {
    if (from == home) return;
    check(cudaMemcpyAsync(home, from, n * sizeof(T), cudaMemcpyDeviceToDevice, stream),
          "copying what was sorted");
}

}  // namespace detail

inline std::size_t Queue::scratch_bytes(std::uint32_t n) const {
    const ActiveDevice active(device_);
    detail::forget_errors_of_others();
    return std::max(detail::SortScratch(n).size(), detail::sum_scratch(n));
}

inline void Queue::sort_by_key(std::uint32_t n, std::uint64_t* keys, std::uint32_t* values,
                               Buffer<std::byte>& scratch) {
    if (n == 0) return;
    const ActiveDevice active(device_);
    detail::forget_errors_of_others();
    const detail::SortScratch parts(n);
    expects(scratch.size() >= parts.size(), "the scratch buffer is too small to sort in");
    std::byte* const at = scratch.data();
    cub::DoubleBuffer<std::uint64_t> by(keys, reinterpret_cast<std::uint64_t*>(at));
    cub::DoubleBuffer<std::uint32_t> what(values,
                                          reinterpret_cast<std::uint32_t*>(at + parts.values));
    std::size_t notes_size = parts.notes_size;
    check(
        cub::DeviceRadixSort::SortPairs(at + parts.notes, notes_size, by, what, n, 0, 64, stream_),
        "sorting");
    detail::bring_home(by.Current(), keys, n, stream_);
    detail::bring_home(what.Current(), values, n, stream_);
}

inline void Queue::sum_before(std::uint32_t n, const std::uint32_t* from, std::uint32_t* sums,
                              Buffer<std::byte>& scratch) {
    if (n == 0) return;
    const ActiveDevice active(device_);
    detail::forget_errors_of_others();
    std::size_t bytes = detail::sum_scratch(n);
    expects(scratch.size() >= bytes, "the scratch buffer is too small to add up in");
    check(cub::DeviceScan::ExclusiveSum(scratch.data(), bytes, from, sums, n, stream_),
          "adding up");
}

}  // namespace mir::cuda
