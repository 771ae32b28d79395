// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/cuda/active_device.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace mir::cuda {

/// What a backend takes.
enum class MemoryKind {
    device,  ///< memory of the GPU
    pinned   ///< host memory that the GPU copies from and to without the CPU
};

/// Asked before each allocation, with its kind and its bytes. False refuses it as if there were no
/// memory left. Lets a program bound what mir takes, and tests make any allocation fail. Called
/// from the thread that allocates, one call at a time; must not allocate from the same backend.
using AllocationHook = std::function<bool(MemoryKind kind, std::size_t bytes)>;

/// Where all buffers of one backend come from. Taking memory from CUDA costs up to milliseconds (a
/// millisecond for 4 MiB of pinned memory) and stops the GPU, so memory that is given back is kept
/// for the next image: all together never more than twice what was once in use. Thread-safe.
class Memory {
 public:
    /// Of the GPU of that ordinal; takes nothing yet. Without a `hook` nothing is refused.
    explicit Memory(int device, AllocationHook hook = {})
        : device_(device), hook_(std::move(hook)) {}
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    ~Memory() { trim(); }

    /// Memory of at least `bytes` bytes, aligned to 256. Its contents are not defined.
    /// @throws Error(out_of_memory) when there is not enough or the hook refuses.
    [[nodiscard]] void* take(MemoryKind kind, std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        const std::size_t rounded = rounded_up(bytes);
        if (hook_ && !hook_(kind, bytes)) refuse(kind, bytes, "an allocation hook refused it");
        Pool& pool = pool_of(kind);
        void* block = pool.take_idle(rounded);
        if (block == nullptr) block = allocate(kind, pool, rounded, bytes);
        pool.in_use += rounded;
        pool.peak = std::max(pool.peak, pool.in_use);
        return block;
    }

    /// Takes back what take() of the same kind and size returned. No queue may still work on it.
    void give_back(MemoryKind kind, void* block, std::size_t bytes) noexcept {
        const std::lock_guard lock(mutex_);
        Pool& pool = pool_of(kind);
        pool.in_use -= rounded_up(bytes);
        // A list that cannot grow must not leak what it was to hold.
        try {
            pool.idle.emplace(rounded_up(bytes), block);
            pool.idle_bytes += rounded_up(bytes);
        } catch (...) {
            release_on(device_, [kind, block] { release(kind, block); });
        }
    }

    /// Gives idle memory back to CUDA.
    void trim() noexcept {
        const std::lock_guard lock(mutex_);
        trim_locked();
    }

    /// Bytes that no buffer holds, kept for the next.
    [[nodiscard]] std::size_t idle(MemoryKind kind) const {
        const std::lock_guard lock(mutex_);
        return pools_[static_cast<std::size_t>(kind)].idle_bytes;
    }
    /// Bytes that buffers hold now.
    [[nodiscard]] std::size_t in_use(MemoryKind kind) const {
        const std::lock_guard lock(mutex_);
        return pools_[static_cast<std::size_t>(kind)].in_use;
    }
    /// Most bytes that buffers held at one time.
    [[nodiscard]] std::size_t peak(MemoryKind kind) const {
        const std::lock_guard lock(mutex_);
        return pools_[static_cast<std::size_t>(kind)].peak;
    }

 private:
    struct Pool {
        std::multimap<std::size_t, void*> idle = {};
        std::size_t idle_bytes = 0;
        std::size_t in_use = 0;
        std::size_t peak = 0;

        void* take_idle(std::size_t rounded) {
            const auto found = idle.find(rounded);
            if (found == idle.end()) return nullptr;
            void* block = found->second;
            idle.erase(found);
            idle_bytes -= rounded;
            return block;
        }
    };

    /// Steps of an eighth, so that images of nearly one size share their blocks.
    static std::size_t rounded_up(std::size_t bytes) {
        std::size_t step = 256;
        while (step < bytes / 8) step *= 2;
        return bytes > largest ? bytes : (bytes + step - 1) / step * step;
    }

    Pool& pool_of(MemoryKind kind) { return pools_[static_cast<std::size_t>(kind)]; }

    void* allocate(MemoryKind kind, Pool& pool, std::size_t rounded, std::size_t bytes) {
        if (bytes > largest) refuse(kind, bytes, "no machine has that much");
        const ActiveDevice active(device_);
        const std::size_t most = 2 * std::max(pool.peak, pool.in_use + rounded);
        if (pool.in_use + pool.idle_bytes + rounded > most) trim_locked(kind);
        void* block = nullptr;
        cudaError_t status = acquire(kind, &block, rounded);
        if (status == cudaErrorMemoryAllocation) {
            static_cast<void>(cudaGetLastError());
            trim_locked();
            status = acquire(kind, &block, rounded);
        }
        if (status == cudaErrorMemoryAllocation) {
            static_cast<void>(cudaGetLastError());
            refuse(kind, bytes, "not that much is free");
        }
        check(status, kind == MemoryKind::device ? "taking memory of the GPU"
                                                 : "taking pinned memory of the host");
        return block;
    }

    static cudaError_t acquire(MemoryKind kind, void** block, std::size_t bytes) {
        return kind == MemoryKind::device ? cudaMalloc(block, bytes)
                                          : cudaHostAlloc(block, bytes, cudaHostAllocPortable);
    }
    static void release(MemoryKind kind, void* block) {
        static_cast<void>(kind == MemoryKind::device ? cudaFree(block) : cudaFreeHost(block));
    }

    void trim_locked() noexcept {
        for (MemoryKind kind : {MemoryKind::device, MemoryKind::pinned}) trim_locked(kind);
    }
    // The capture list says its order: behind [&] nvcc and the C++ compiler may lay a closure out
    // differently, and release_on() of one file would then read that of another.
    void trim_locked(MemoryKind kind) noexcept {
        release_on(device_, [this, kind] {
            Pool& pool = pool_of(kind);
            for (const auto& [size, block] : pool.idle) release(kind, block);
            pool.idle.clear();
            pool.idle_bytes = 0;
        });
    }

    [[noreturn]] static void refuse(MemoryKind kind, std::size_t bytes, const char* why) {
        const char* what =
            kind == MemoryKind::device ? " bytes of GPU memory" : " bytes of pinned host memory";
        throw Error(ErrorCode::out_of_memory,
                    std::to_string(bytes) + what + " could not be taken (" + why +
                        "); use smaller tiles, fewer VPLs or a smaller scene, or end other "
                        "programs that use the GPU");
    }

    /// More than any machine has; drivers answer such requests with other errors.
    static constexpr std::size_t largest = std::size_t{1} << 45;

    int device_ = 0;
    AllocationHook hook_;
    mutable std::mutex mutex_;
    std::array<Pool, 2> pools_{};
};

/// Bytes from a Memory, given back at the end. Move-only; none for zero bytes.
class MemoryBlock {
 public:
    MemoryBlock() = default;
    /// Room for `count` elements of `element_bytes` bytes.
    /// @throws Error(out_of_memory)
    MemoryBlock(std::shared_ptr<Memory> memory, MemoryKind kind, std::size_t count,
                std::size_t element_bytes)
        : memory_(std::move(memory)), kind_(kind), bytes_(saturating_mul(count, element_bytes)) {
        if (bytes_ > 0) data_ = memory_->take(kind_, bytes_);
    }
    MemoryBlock(const MemoryBlock&) = delete;
    MemoryBlock& operator=(const MemoryBlock&) = delete;
    /// `other` holds nothing afterwards.
    MemoryBlock(MemoryBlock&& other) noexcept { swap(other); }
    /// Gives back what this held; `other` holds nothing afterwards.
    MemoryBlock& operator=(MemoryBlock&& other) noexcept {
        MemoryBlock(std::move(other)).swap(*this);
        return *this;
    }
    ~MemoryBlock() {
        if (data_ != nullptr) memory_->give_back(kind_, data_, bytes_);
    }

    /// The first byte, in the memory of its kind; null for none.
    [[nodiscard]] void* data() const { return data_; }

 private:
    void swap(MemoryBlock& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(kind_, other.kind_);
        std::swap(bytes_, other.bytes_);
        std::swap(data_, other.data_);
    }

    std::shared_ptr<Memory> memory_;
    MemoryKind kind_ = MemoryKind::device;
    std::size_t bytes_ = 0;
    void* data_ = nullptr;
};

}  // namespace mir::cuda
