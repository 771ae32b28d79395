// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/check_input.hpp"
#include "io/detail/jpeg_tables.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace mir::detail {

using ByteSpan = std::span<const unsigned char>;

inline bool is_png(ByteSpan bytes) {
    constexpr std::array<unsigned char, 8> mark = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
}

inline bool is_jpeg(ByteSpan bytes) {
    return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

/// Width and height as a header tells them; zeros where it does not.
struct ImageSize {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
};

/// Four bytes of a PNG image, the largest first.
inline std::uint64_t png_number(ByteSpan bytes, std::size_t at) {
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) n = n << 8 | bytes[at + i];
    return n;
}

/// Source: W3C, PNG specification, 11.2.2 (IHDR comes first).
inline ImageSize png_size(ByteSpan bytes) {
    if (bytes.size() < 24) return {};
    return {png_number(bytes, 16), png_number(bytes, 20)};
}

/// Refuses a PNG image with a chunk larger than the file. The decoder takes memory for it before it
/// looks. Source: W3C, PNG specification, 5.3 (chunks).
/// @throws Error(invalid_input)
inline void check_png_chunks(ByteSpan bytes, const std::string& place) {
    constexpr std::size_t mark = 8;
    constexpr std::size_t around = 12;  // length, type and checksum
    for (std::size_t at = mark; at + around <= bytes.size();) {
        const std::uint64_t length = png_number(bytes, at);
        if (length > bytes.size() - at - around)
            fail_at(place, "it is no image (its chunk at byte " + std::to_string(at) +
                               " announces " + std::to_string(length) + " bytes, of which " +
                               std::to_string(bytes.size() - at - around) +
                               " are there); repair or export the image again");
        at += around + static_cast<std::size_t>(length);
    }
}

/// Source: ITU-T T.81, annex B: segments up to the first start of frame.
inline ImageSize jpeg_size(ByteSpan bytes) {
    std::size_t at = 2;
    while (at + 9 < bytes.size() && bytes[at] == 0xff) {
        const unsigned char marker = bytes[at + 1];
        // Fill bytes, and marks without a length.
        if (marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) {
            at += marker == 0xff ? 1 : 2;
            continue;
        }
        const bool is_frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        const auto pair = [&](std::size_t k) {
            return std::uint64_t{bytes[k]} << 8 | std::uint64_t{bytes[k + 1]};
        };
        if (is_frame) return {pair(at + 7), pair(at + 5)};
        at += 2 + static_cast<std::size_t>(pair(at + 2));
    }
    return {};
}

/// Texels of a PNG or JPEG image, checked before it is decoded.
/// @throws Error(invalid_input) when there are none, or so many that its bytes cannot hold them:
/// the
///         decoder takes memory for what a header announces.
inline std::uint64_t checked_texels(ByteSpan bytes, const std::string& place) {
    const ImageSize size = is_png(bytes) ? png_size(bytes) : jpeg_size(bytes);
    constexpr std::uint64_t largest = 65536;
    // Deflate makes 1032 bytes of one at most, and a JPEG block takes some bits.
    constexpr std::uint64_t texels_per_byte = 8192;
    if (size.width == 0 || size.height == 0 || size.width > largest || size.height > largest ||
        size.width * size.height / texels_per_byte > bytes.size())
        fail_at(place, "it is no image (its " + std::to_string(bytes.size()) + " bytes announce " +
                           std::to_string(size.width) + " x " + std::to_string(size.height) +
                           " pixels); repair or export the image again");
    if (is_png(bytes))
        check_png_chunks(bytes, place);
    else
        check_jpeg_tables(bytes, place);
    return size.width * size.height;
}

/// Packs RGBA of `depth` bytes a channel, those of 16 bits in this machine's order.
inline std::vector<std::uint32_t> texels_of(const std::vector<unsigned char>& rgba,
                                            std::size_t depth) {
    std::vector<std::uint32_t> texels(rgba.size() / (4 * depth));
    for (std::size_t i = 0; i < texels.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const unsigned char* channel = rgba.data() + (4 * i + k) * depth;
            std::uint32_t code = channel[0];
            if (depth == 2) {
                std::uint16_t wide = 0;
                std::memcpy(&wide, channel, sizeof wide);
                code = (std::uint32_t{wide} + 128) / 257;
            }
            texels[i] |= code << 8 * k;
        }
    return texels;
}

}  // namespace mir::detail
