// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/core/space.hpp"
#include "mir/cuda/queue.hpp"
#include "mir/data/blocked_layout.hpp"

#include <cuda_runtime.h>

#include <algorithm>
#include <string>

namespace mir::cuda {

namespace detail {

/// Threads of a block: a 16x16 block of luxels. The blocked index of a luxel is the global index of
/// its thread.
inline constexpr std::uint32_t threads_per_block = BlockedLayout::block_size;

/// Bytes of fast memory that a block may have without asking for more.
inline constexpr std::size_t workspace_bytes = 48 * 1024;

/// Warps of a block that runs groups of lanes. Few, because a block keeps its place until its
/// slowest warp is done, and no more than there is room for.
template <class Kernel>
inline constexpr std::uint32_t groups_per_block = static_cast<std::uint32_t>(
    std::clamp<std::size_t>(workspace_bytes / sizeof(typename Kernel::Workspace), 1, 4));
template <class Kernel>
inline constexpr std::uint32_t threads_of_groups = groups_per_block<Kernel>* LaneGroup::width;

/// Blocks of `size` that hold `n`.
constexpr std::uint32_t blocks_for(std::uint32_t n, std::uint32_t size) {
    return n / size + (n % size != 0 ? 1 : 0);
}

/// What a kernel may be, in words.
template <class Kernel>
constexpr void check_kernel() {
    static_assert(DeviceCopyable<Kernel>,
                  "mir: a kernel for the GPU must be trivially copyable (its bytes are all that "
                  "reaches the device)");
    static_assert(sizeof(Kernel) <= 4000,
                  "mir: a kernel for the GPU must not be larger than 4000 bytes, the room for "
                  "arguments; put data into a buffer");
}

/// Least number of blocks that a multiprocessor is to hold, from the kernel's `resident_blocks`.
/// The compiler then has to do with fewer registers. 0: as the compiler likes.
template <class Kernel>
inline constexpr std::uint32_t resident_blocks = 0;
template <class Kernel>
    requires requires { Kernel::resident_blocks; }
inline constexpr std::uint32_t resident_blocks<Kernel> = Kernel::resident_blocks;

template <class Kernel>
__global__ void __launch_bounds__(threads_per_block, resident_blocks<Kernel>)
    for_each_index(std::uint32_t n, const __grid_constant__ Kernel kernel) {
    const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < n) kernel(i);
}

/// A thread per row; the warp votes once for each column. Lane k keeps the word of the k-th of 32
/// columns, so that 32 neighbouring words leave in one transaction.
template <class Kernel>
__global__ void __launch_bounds__(threads_per_block)
    fill_bit_words(std::uint32_t rows, std::uint32_t columns, const __grid_constant__ Kernel kernel,
                   std::uint32_t* __restrict__ words) {
    constexpr std::uint32_t width = 32;
    constexpr std::uint32_t all_lanes = 0xFFFFFFFFu;
    const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i >= rows) return;  // whole warps: rows come in multiples of 32
    const std::uint32_t lane = threadIdx.x % width;
    std::uint32_t* out = words + std::size_t{i / width} * columns;
    const auto row = kernel.row(i);
    for (std::uint32_t first = 0; first < columns; first += width) {
        const std::uint32_t count = columns - first < width ? columns - first : width;
        std::uint32_t kept = 0;
#pragma unroll 1
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t word = __ballot_sync(all_lanes, kernel(row, first + k));
            kept = lane == k ? word : kept;
        }
        if (lane < count) out[first + lane] = kept;
    }
}

/// A warp per index. Lanes leave together: conditions on `i` are the same for all of them.
template <class Kernel>
__global__ void __launch_bounds__(threads_of_groups<Kernel>, resident_blocks<Kernel>)
    for_each_group_index(std::uint32_t n, const __grid_constant__ Kernel kernel) {
    __shared__ typename Kernel::Workspace spaces[groups_per_block<Kernel>];
    const std::uint32_t warp = threadIdx.x / LaneGroup::width;
    const std::uint32_t i = blockIdx.x * groups_per_block<Kernel> + warp;
    // Where the compiler knows how to recompute the address it does so in every loop, which costs
    // more than the register. It still has to know that the address is of shared memory.
    void* own = spaces + warp;
    asm volatile("" : "+l"(own));
    __builtin_assume(__isShared(own));
    if (i < n) kernel(LaneGroup{}, i, *static_cast<typename Kernel::Workspace*>(own));
}

/// Refuses a kernel whose argument sizes differ between the device's and the host's compiler. They
/// do not agree about members that are [[no_unique_address]], and such a kernel would read its
/// arguments at the wrong places. Members that move within the same size go unseen. Asks nothing
/// before CUDA 12.4, which knew no answer.
template <class... Arguments>
void check_argument_layout([[maybe_unused]] void (*kernel)(Arguments...)) {
#if CUDART_VERSION >= 12040
    std::size_t index = 0;
    for (const std::size_t here : {sizeof(Arguments)...}) {
        std::size_t offset = 0;
        std::size_t there = 0;
        check(cudaFuncGetParamInfo(reinterpret_cast<const void*>(kernel), index++, &offset, &there),
              "asking for the size of a kernel's argument");
        if (here != there)
            throw Error(ErrorCode::internal,
                        "a kernel's argument has " + std::to_string(here) +
                            " bytes for the host's compiler and " + std::to_string(there) +
                            " for the device's; keep members that are [[no_unique_address]] out of "
                            "kernels");
    }
#endif
}

/// Starts a kernel in `blocks` blocks of `threads` threads. The status is the launch's own: an
/// error that the caller's CUDA code left behind is not taken for ours.
template <class... Expected, class... Given>
void launch(std::uint32_t blocks, std::uint32_t threads, cudaStream_t stream,
            void (*kernel)(Expected...), const Given&... arguments) {
    // Once is enough: kernels of the same types have arguments of the same sizes.
    [[maybe_unused]] static const bool same_layout = (check_argument_layout(kernel), true);
    cudaLaunchConfig_t config{};
    config.gridDim = dim3(blocks);
    config.blockDim = dim3(threads);
    config.stream = stream;
    check(cudaLaunchKernelEx(&config, kernel, arguments...), "starting a kernel");
}

}  // namespace detail

template <class Kernel>
void Queue::for_each(std::uint32_t n, const Kernel& kernel) {
    detail::check_kernel<Kernel>();
    if (n == 0) return;
    const ActiveDevice active(device_);
    detail::launch(detail::blocks_for(n, detail::threads_per_block), detail::threads_per_block,
                   stream_, detail::for_each_index<Kernel>, n, kernel);
}

template <class Kernel>
void Queue::fill_bits(std::uint32_t rows, std::uint32_t columns, const Kernel& kernel,
                      std::uint32_t* words) {
    detail::check_kernel<Kernel>();
    expects(rows % 32 == 0, "bits are made 32 rows at a time; pad the rows");
    if (rows == 0 || columns == 0) return;
    const ActiveDevice active(device_);
    detail::launch(detail::blocks_for(rows, detail::threads_per_block), detail::threads_per_block,
                   stream_, detail::fill_bit_words<Kernel>, rows, columns, kernel, words);
}

template <class Kernel>
void Queue::for_each_group(std::uint32_t n, const Kernel& kernel) {
    detail::check_kernel<Kernel>();
    static_assert(sizeof(typename Kernel::Workspace) <= detail::workspace_bytes,
                  "mir: a kernel's Workspace must not be larger than 48 kB, what a group may have "
                  "of fast memory");
    if (n == 0) return;
    const ActiveDevice active(device_);
    constexpr std::uint32_t groups = detail::groups_per_block<Kernel>;
    detail::launch(detail::blocks_for(n, groups), detail::threads_of_groups<Kernel>, stream_,
                   detail::for_each_group_index<Kernel>, n, kernel);
}

}  // namespace mir::cuda
