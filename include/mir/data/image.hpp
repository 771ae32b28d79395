// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/tile.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace mir {

/// Rows of T, top row first. Owns its elements.
template <class T>
class Image {
 public:
    Image() = default;
    explicit Image(Extent extent, T value = {})
        : extent_(extent), data_(static_cast<std::size_t>(extent.area()), value) {}

    [[nodiscard]] Extent extent() const { return extent_; }
    [[nodiscard]] std::uint32_t width() const { return extent_.width; }
    [[nodiscard]] std::uint32_t height() const { return extent_.height; }

    [[nodiscard]] T& operator()(std::uint32_t x, std::uint32_t y) {
        return data_[std::size_t{y} * extent_.width + x];
    }
    [[nodiscard]] const T& operator()(std::uint32_t x, std::uint32_t y) const {
        return data_[std::size_t{y} * extent_.width + x];
    }

    [[nodiscard]] std::span<T> pixels() { return data_; }
    [[nodiscard]] std::span<const T> pixels() const { return data_; }

 private:
    Extent extent_;
    std::vector<T> data_;
};

}  // namespace mir
