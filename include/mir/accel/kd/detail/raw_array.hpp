// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace mir::detail {

/// Growing array whose new elements are not written. Page by page first touched by whoever fills
/// them. For plain values only.
template <class T>
class RawArray {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    static_assert(alignof(T) <= alignof(std::max_align_t));

 public:
    RawArray() = default;
    explicit RawArray(std::size_t size) { resize(size); }
    RawArray(const RawArray&) = delete;
    RawArray& operator=(const RawArray&) = delete;
    RawArray(RawArray&& other) noexcept { swap(other); }
    RawArray& operator=(RawArray&& other) noexcept {
        RawArray taken(std::move(other));
        swap(taken);
        return *this;
    }
    ~RawArray() { std::free(data_); }  // NOLINT(cppcoreguidelines-no-malloc)

    [[nodiscard]] T* data() { return data_; }
    [[nodiscard]] const T* data() const { return data_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T& operator[](std::size_t i) { return data_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data_[i]; }
    [[nodiscard]] std::span<const T> span() const { return {data_, size_}; }

    void resize(std::size_t size) {
        if (size > capacity_) grow(size);
        size_ = size;
    }

    /// Like resize(), but what the array held is lost. Leaves some room to grow, which costs
    /// nothing until it is touched.
    void replace(std::size_t size) {
        if (size > capacity_) {
            *this = RawArray();
            grow(size + size / 4);
        }
        size_ = size;
    }

    void push_back(T value) {
        resize(size_ + 1);
        data_[size_ - 1] = value;
    }

 private:
    // realloc() moves the pages of large blocks instead of copying what is in them.
    [[gnu::noinline]] void grow(std::size_t at_least) {
        const std::size_t capacity = std::max(at_least, capacity_ + capacity_ / 2 + 16);
        // NOLINTNEXTLINE(cppcoreguidelines-no-malloc)
        void* const larger = std::realloc(static_cast<void*>(data_), capacity * sizeof(T));
        if (larger == nullptr) throw std::bad_alloc();
        data_ = static_cast<T*>(larger);
        capacity_ = capacity;
    }

    void swap(RawArray& other) {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }

    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

}  // namespace mir::detail
