// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/memory.hpp"

#include <type_traits>

namespace mir::cuda {

/// Elements in the memory of a GPU. Not defined until something is copied or computed there.
/// Move-only. It must not end before the work that uses it has: end the queues first.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

 public:
    Buffer() = default;
    /// @throws Error(out_of_memory)
    Buffer(std::shared_ptr<Memory> memory, std::size_t size)
        : block_(std::move(memory), MemoryKind::device, size, sizeof(T)), size_(size) {}

    /// Device address of the first element; null when there is none.
    [[nodiscard]] T* data() { return static_cast<T*>(block_.data()); }
    /// The same to read.
    [[nodiscard]] const T* data() const { return static_cast<const T*>(block_.data()); }
    /// Number of elements.
    [[nodiscard]] std::size_t size() const { return size_; }

 private:
    MemoryBlock block_;
    std::size_t size_ = 0;
};

}  // namespace mir::cuda
