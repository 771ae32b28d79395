// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/check_input.hpp"
#include "mir/scene/texture_image.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace mir::detail {

/// Refuses Huffman tables with more codes than JPEG knows. stb_image, before its version
/// 2.27, writes them past the end of its own table. `at`: the first byte behind the
/// mark.
inline void check_huffman_tables(std::span<const unsigned char> bytes, std::size_t at,
                                 const std::string& place) {
    constexpr std::size_t most = 256;
    constexpr std::size_t counts = 16;
    if (at + 2 > bytes.size()) return;
    const std::size_t end = at + (std::size_t{bytes[at]} << 8 | bytes[at + 1]);
    for (at += 2; at < end && at + 1 + counts <= bytes.size();) {
        std::size_t codes = 0;
        for (std::size_t i = 0; i < counts; ++i) codes += bytes[at + 1 + i];
        if (codes > most)
            fail_at(place, "it is no image (a Huffman table of " + std::to_string(codes) +
                               " codes; JPEG has 256 at most); repair or export the image again");
        at += 1 + counts + codes;
    }
}

/// The same for all tables of a JPEG image.
/// @throws Error(invalid_input)
/// Source: ITU-T T.81, annex B.2.4.2.
inline void check_jpeg_tables(std::span<const unsigned char> bytes, const std::string& place) {
    constexpr unsigned char tables = 0xc4;
    constexpr unsigned char scan = 0xda;
    std::size_t at = 2;
    // Segments say how long they are, and may hold anything, until the first scan.
    while (at + 4 <= bytes.size() && bytes[at] == 0xff && bytes[at + 1] != scan) {
        const unsigned char marker = bytes[at + 1];
        if (marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd9)) {
            at += marker == 0xff ? 1 : 2;
            continue;
        }
        if (marker == tables) check_huffman_tables(bytes, at + 2, place);
        at += 2 + (std::size_t{bytes[at + 2]} << 8 | bytes[at + 3]);
    }
    // Coded data hold no mark.
    for (; at + 1 < bytes.size(); ++at)
        if (bytes[at] == 0xff && bytes[at + 1] == tables)
            check_huffman_tables(bytes, at + 2, place);
}

}  // namespace mir::detail
