// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/printable.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mir::detail {

/// Text that no reader of HTML takes for markup, in elements or quoted attributes. Nor does it show
/// other letters than it has: it is made printable().
inline std::string html_escaped(const std::string& text) {
    std::string out;
    for (const char c : printable(text, std::string::npos)) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

/// Base64 of RFC 4648, padded.
inline std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr const char* letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < n ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= n ? letters[word >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

}  // namespace mir::detail
