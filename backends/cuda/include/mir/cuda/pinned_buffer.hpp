// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/memory.hpp"

#include <span>
#include <type_traits>

namespace mir::cuda {

/// Elements in pinned host memory, from which copies run beside kernels; copies from other memory
/// hold the caller up. Not defined until written. Move-only.
template <class T>
class PinnedBuffer {
    static_assert(std::is_trivially_copyable_v<T>);

 public:
    PinnedBuffer() = default;
    /// @throws Error(out_of_memory)
    PinnedBuffer(std::shared_ptr<Memory> memory, std::size_t size)
        : block_(std::move(memory), MemoryKind::pinned, size, sizeof(T)), size_(size) {}

    [[nodiscard]] T* data() { return static_cast<T*>(block_.data()); }
    [[nodiscard]] const T* data() const { return static_cast<const T*>(block_.data()); }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::span<T> span() { return {data(), size_}; }
    [[nodiscard]] std::span<const T> span() const { return {data(), size_}; }

 private:
    MemoryBlock block_;
    std::size_t size_ = 0;
};

/// Standard allocator of pinned memory, so that a BlockedGBuffer goes to the GPU without a stop on
/// the way: `BlockedGBuffer<Params, PinnedAllocator<std::uint32_t>>`. Backend::pinned() makes one.
/// Keeps the memory's source alive. Thread-safe.
template <class T>
class PinnedAllocator {
 public:
    using value_type = T;

    explicit PinnedAllocator(std::shared_ptr<Memory> memory) : memory_(std::move(memory)) {}
    template <class U>
    PinnedAllocator(const PinnedAllocator<U>& other) : memory_(other.memory()) {}

    /// @throws Error(out_of_memory)
    [[nodiscard]] T* allocate(std::size_t count) {
        return static_cast<T*>(memory_->take(MemoryKind::pinned, bytes_of(count)));
    }
    void deallocate(T* elements, std::size_t count) noexcept {
        memory_->give_back(MemoryKind::pinned, elements, bytes_of(count));
    }

    [[nodiscard]] const std::shared_ptr<Memory>& memory() const { return memory_; }
    template <class U>
    friend bool operator==(const PinnedAllocator& a, const PinnedAllocator<U>& b) {
        return a.memory() == b.memory();
    }

 private:
    static std::size_t bytes_of(std::size_t count) { return saturating_mul(count, sizeof(T)); }

    std::shared_ptr<Memory> memory_;
};

}  // namespace mir::cuda
