// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/raw_allocator.hpp"
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
    /// An image of `extent` with the same `value` everywhere.
    explicit Image(Extent extent, T value = {})
        : extent_(extent), data_(static_cast<std::size_t>(extent.area()), value) {}

    /// An image whose elements have no value yet. For code that writes every one of them, from
    /// several threads if it likes.
    static Image unwritten(Extent extent) {
        Image image;
        image.extent_ = extent;
        image.data_.resize(static_cast<std::size_t>(extent.area()));
        return image;
    }

    /// Columns and rows; zero for an image made without an extent.
    [[nodiscard]] Extent extent() const { return extent_; }
    /// Columns.
    [[nodiscard]] std::uint32_t width() const { return extent_.width; }
    /// Rows.
    [[nodiscard]] std::uint32_t height() const { return extent_.height; }

    /// The element in column x and row y, both below the extent: not checked.
    [[nodiscard]] T& operator()(std::uint32_t x, std::uint32_t y) {
        return data_[std::size_t{y} * extent_.width + x];
    }
    /// The same, to be read.
    [[nodiscard]] const T& operator()(std::uint32_t x, std::uint32_t y) const {
        return data_[std::size_t{y} * extent_.width + x];
    }

    /// All elements, row after row without gaps. Valid until the image is assigned, moved or ends.
    [[nodiscard]] std::span<T> pixels() { return data_; }
    /// The same, to be read.
    [[nodiscard]] std::span<const T> pixels() const { return data_; }

 private:
    Extent extent_;
    std::vector<T, RawAllocator<T>> data_;
};

}  // namespace mir
