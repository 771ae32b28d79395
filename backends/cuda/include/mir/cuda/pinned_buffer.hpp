// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/memory.hpp"

#include <span>
#include <type_traits>

namespace mir::cuda {

/// Elements in pinned host memory, from which copies run beside kernels. Copies from other memory
/// hold the caller up. Not defined until written. Move-only.
template <class T>
class PinnedBuffer {
    static_assert(std::is_trivially_copyable_v<T>);

 public:
    PinnedBuffer() = default;
    /// @throws Error(out_of_memory)
    PinnedBuffer(std::shared_ptr<Memory> memory, std::size_t size)
        : block_(std::move(memory), MemoryKind::pinned, size, sizeof(T)), size_(size) {}

    /// The first element; null when there is none.
    [[nodiscard]] T* data() { return static_cast<T*>(block_.data()); }
    /// The same to read.
    [[nodiscard]] const T* data() const { return static_cast<const T*>(block_.data()); }
    /// Number of elements.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// All elements.
    [[nodiscard]] std::span<T> span() { return {data(), size_}; }
    /// All elements, to read.
    [[nodiscard]] std::span<const T> span() const { return {data(), size_}; }

 private:
    MemoryBlock block_;
    std::size_t size_ = 0;
};

/// Standard allocator of pinned memory. A BlockedGBuffer then goes to the GPU without a stop:
/// `BlockedGBuffer<Params, PinnedAllocator<std::uint32_t>>`. Backend::pinned() makes one. Keeps the
/// memory's source alive. Thread-safe.
template <class T>
class PinnedAllocator {
 public:
    using value_type = T;  ///< what it allocates, as the standard asks for it

    /// Takes from `memory`, which is not null.
    explicit PinnedAllocator(std::shared_ptr<Memory> memory) : memory_(std::move(memory)) {}
    /// Takes from the memory that the other takes from.
    template <class U>
    PinnedAllocator(const PinnedAllocator<U>& other) : memory_(other.memory()) {}

    /// @throws Error(out_of_memory)
    [[nodiscard]] T* allocate(std::size_t count) {
        return static_cast<T*>(memory_->take(MemoryKind::pinned, bytes_of(count)));
    }
    /// Gives back what allocate() of the same count returned. No queue may still copy from or to
    /// it.
    void deallocate(T* elements, std::size_t count) noexcept {
        memory_->give_back(MemoryKind::pinned, elements, bytes_of(count));
    }

    /// What it takes from.
    [[nodiscard]] const std::shared_ptr<Memory>& memory() const { return memory_; }
    /// True when both take from one Memory: what one allocates, the other may free.
    template <class U>
    friend bool operator==(const PinnedAllocator& a, const PinnedAllocator<U>& b) {
        return a.memory() == b.memory();
    }

 private:
    static std::size_t bytes_of(std::size_t count) { return saturating_mul(count, sizeof(T)); }

    std::shared_ptr<Memory> memory_;
};

}  // namespace mir::cuda
