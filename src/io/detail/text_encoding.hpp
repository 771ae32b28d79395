// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/read_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace mir::detail {

/// Appends one code point as UTF-8.
inline void append_utf8(std::uint32_t code, std::string& text) {
    const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
    if (code < 0x80) return put(code);
    if (code < 0x800) {
        put(0xc0 | code >> 6);
    } else {
        if (code < 0x10000) {
            put(0xe0 | code >> 12);
        } else {
            put(0xf0 | code >> 18);
            put(0x80 | (code >> 12 & 0x3f));
        }
        put(0x80 | (code >> 6 & 0x3f));
    }
    put(0x80 | (code & 0x3f));
}

inline std::string utf16_to_utf8(const Bytes& bytes, bool big_endian) {
    const auto unit = [&](std::size_t i) -> std::uint32_t {
        const std::uint32_t first = bytes[i];
        const std::uint32_t second = bytes[i + 1];
        return big_endian ? first << 8 | second : second << 8 | first;
    };
    constexpr std::uint32_t replacement = 0xfffd;
    std::string text;
    text.reserve(bytes.size() / 2);
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
        std::uint32_t code = unit(i);
        if (code >= 0xd800 && code < 0xe000) {
            const std::uint32_t low = i + 3 < bytes.size() ? unit(i + 2) : 0;
            const bool pair = code < 0xdc00 && low >= 0xdc00 && low < 0xe000;
            code = pair ? 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00) : replacement;
            if (pair) i += 2;
        }
        append_utf8(code, text);
    }
    return text;
}

/// The text of a file as its byte order mark says. UTF-16 is converted, everything else kept.
inline std::string text_of(const Bytes& bytes) {
    const std::size_t n = bytes.size();
    if (n >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff) return utf16_to_utf8(bytes, true);
    if (n >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe) return utf16_to_utf8(bytes, false);
    const bool marked = n >= 3 && bytes[0] == 0xef && bytes[1] == 0xbb && bytes[2] == 0xbf;
    return {bytes.begin() + (marked ? 3 : 0), bytes.end()};
}

}  // namespace mir::detail
