// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstdint>
#include <type_traits>

namespace mir {

/// Up to N elements inside the object, with the kernels' part of std::vector's interface. Growing
/// past N is the caller's error and not checked. Trivially copyable: a copy is one of all N
/// elements.
template <class T, std::uint32_t N>
class InlineVector {
    static_assert(std::is_trivially_copyable_v<T>);

 public:
    /// Number of elements, at most N.
    [[nodiscard]] MIR_HD std::uint32_t size() const { return size_; }
    /// Element i < size(), not checked.
    [[nodiscard]] MIR_HD const T& operator[](std::uint32_t i) const { return elements_[i]; }
    /// Element i < size(), not checked.
    [[nodiscard]] MIR_HD T& operator[](std::uint32_t i) { return elements_[i]; }
    /// The last element; there must be one.
    [[nodiscard]] MIR_HD const T& back() const { return elements_[size_ - 1]; }

    /// Forgets all elements.
    MIR_HD void clear() { size_ = 0; }
    /// Appends a copy; size() must be below N.
    MIR_HD void push_back(const T& value) { elements_[size_++] = value; }
    /// Elements that this adds are what they were before, not new ones.
    MIR_HD void resize(std::uint32_t size) { size_ = size; }
    /// The first `count` elements of another.
    MIR_HD void assign_front(const InlineVector& from, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) elements_[i] = from.elements_[i];
        size_ = count;
    }

 private:
    T elements_[N];
    std::uint32_t size_ = 0;
};

}  // namespace mir
