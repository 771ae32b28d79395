// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/extent.hpp"
#include "mir/io/detail/journal_stream.hpp"
#include "mir/runtime/settings.hpp"

#include <cstddef>
#include <cstdint>

namespace mir::detail {

/// Pixels of some rows of an image that has them.
template <class I>
auto pixels_of(I& image, PixelRows rows) {
    return image.pixels().subspan(rows.first * std::size_t{image.width()},
                                  rows.count * std::size_t{image.width()});
}

/// Writes values; of images some rows alone, none of an empty one.
class RowsWriter : public Transfer<RowsWriter> {
 public:
    RowsWriter(JournalWriter& out, PixelRows rows) : out_(out), rows_(rows) {}

    void bytes(const void* data, std::size_t size) { out_.bytes(data, size); }
    std::uint64_t sized(std::uint64_t size, std::uint64_t bytes_each) {
        return out_.sized(size, bytes_each);
    }
    template <class I>
    void image(const I& image) {
        const bool none = image.pixels().empty();
        const auto pixels = none ? image.pixels() : pixels_of(image, rows_);
        sized(image.width(), 0);
        sized(none ? 0 : rows_.count, 0);
        bytes(pixels.data(), pixels.size_bytes());
    }

 private:
    JournalWriter& out_;
    PixelRows rows_;
};

/// Reads them; rows of images go to their places in whole ones, which it makes where there are
/// none.
class RowsReader : public Transfer<RowsReader> {
 public:
    RowsReader(JournalReader& in, Extent whole, PixelRows rows)
        : in_(in), whole_(whole), rows_(rows) {}

    void bytes(void* data, std::size_t size) { in_.bytes(data, size); }
    std::uint64_t sized(std::uint64_t size, std::uint64_t bytes_each) {
        return in_.sized(size, bytes_each);
    }
    template <class I>
    void image(I& image) {
        const std::uint64_t width = sized(0, 0);
        const std::uint64_t height = sized(0, width * sizeof(image.pixels()[0]));
        if (width == 0 && height == 0) return;
        if (width != whole_.width || height != rows_.count) throw BrokenJournal{};
        if (image.pixels().empty()) image = I(whole_);
        if (image.extent() != whole_) throw BrokenJournal{};
        const auto pixels = pixels_of(image, rows_);
        bytes(pixels.data(), pixels.size_bytes());
    }

 private:
    JournalReader& in_;
    Extent whole_;
    PixelRows rows_;
};

}  // namespace mir::detail
