// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mir {
namespace detail {

/// A character at the front of a text. `bytes` is 0 where the text begins with no UTF-8.
struct CodePoint {
    std::uint32_t value = 0;
    std::size_t bytes = 0;
};

/// Overlong forms, surrogates and what lies beyond U+10FFFF are no UTF-8.
/// Source: RFC 3629, section 4.
inline CodePoint first_code_point(std::string_view text) {
    const auto byte = [&](std::size_t i) -> std::uint32_t {
        return static_cast<unsigned char>(text[i]);
    };
    const std::uint32_t first = byte(0);
    if (first < 0x80) return {first, 1};
    if (first < 0xc2 || first > 0xf4) return {};
    const std::size_t bytes = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (text.size() < bytes) return {};
    std::uint32_t value = first & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return {};
        value = value << 6 | (byte(i) & 0x3f);
    }
    const bool overlong = value < (bytes == 3 ? 0x800u : bytes == 4 ? 0x10000u : 0x80u);
    const bool surrogate = value >= 0xd800 && value < 0xe000;
    return overlong || surrogate || value > 0x10ffff ? CodePoint{} : CodePoint{value, bytes};
}

/// True for what a terminal obeys or what reorders the letters around it. That is C0, DEL, C1,
/// controls of writing direction, and separators of lines and paragraphs.
inline bool is_control(std::uint32_t code) {
    const auto within = [code](std::uint32_t low, std::uint32_t high) {
        return code >= low && code <= high;
    };
    return code < 0x20 || within(0x7f, 0x9f) || code == 0x61c || within(0x200e, 0x200f) ||
           within(0x2028, 0x202e) || within(0x2066, 0x2069);
}

/// `value` in hexadecimal behind a backslash and a letter.
inline std::string escaped(char letter, std::uint32_t value, int digits) {
    std::string text{'\\', letter};
    for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4)
        text += "0123456789abcdef"[value >> shift & 0xf];
    return text;
}

inline std::string escaped_control(std::uint32_t code) {
    if (code == '\n') return "\\n";
    if (code == '\t') return "\\t";
    if (code == '\r') return "\\r";
    return code < 0x80 ? escaped('x', code, 2) : escaped('u', code, 4);
}

}  // namespace detail

/// `text` in a form safe for a terminal, a message or a report. It may come from a stranger's file
/// and becomes one line of valid UTF-8 without controls. Those become `\n`, `\t`, `\r`, `\x1b` or
/// `\u202e`, bytes that are no UTF-8 `\xff`; everything else stays, backslashes too. What is then
/// longer than `longest` bytes ends in "... (N bytes)", N being the size of `text`, and has
/// `longest` bytes with that, or fewer, so that no character is cut; at least that ending. Making
/// printable text printable again changes nothing, for no smaller `longest`. Throws nothing but
/// std::bad_alloc.
inline std::string printable(std::string_view text, std::size_t longest = 200) {
    const std::string ending = "... (" + std::to_string(text.size()) + " bytes)";
    const std::size_t room = longest - std::min(longest, ending.size());
    std::string shown;
    std::size_t kept = 0;  // bytes of `shown` that leave room for the ending
    while (!text.empty()) {
        const detail::CodePoint c = detail::first_code_point(text);
        const std::size_t bytes = std::max<std::size_t>(c.bytes, 1);
        if (c.bytes == 0)
            shown += detail::escaped('x', static_cast<unsigned char>(text[0]), 2);
        else if (detail::is_control(c.value))
            shown += detail::escaped_control(c.value);
        else
            shown += text.substr(0, bytes);
        if (shown.size() > longest) return shown.substr(0, kept) + ending;
        if (shown.size() <= room) kept = shown.size();
        text.remove_prefix(bytes);
    }
    return shown;
}

namespace detail {

/// A name from a file between quotes, for messages.
inline std::string in_quotes(std::string_view name) { return "'" + printable(name) + "'"; }

}  // namespace detail
}  // namespace mir
