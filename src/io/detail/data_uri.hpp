// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_check.hpp"
#include "io/detail/read_file.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

namespace mir::detail {

inline bool equals_in_any_case(std::string_view text, std::string_view lower) {
    if (text.size() != lower.size()) return false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != lower[i]) return false;
    }
    return true;
}

/// A URI with its %20 and the like as the characters that they stand for. A `+` is a `+`.
inline std::string unescaped(std::string_view uri) {
    std::string text;
    text.reserve(uri.size());
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned int code = 0;
        const char* digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// "http" of "http://...", empty for the name of a file. One letter is a drive.
inline std::string_view uri_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon < 2) return {};
    for (const char c : uri.substr(0, colon)) {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const bool is_other = (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
        if (!is_letter && !is_other) return {};
    }
    return uri.substr(0, colon);
}

inline bool is_data_uri(std::string_view uri) {
    return equals_in_any_case(uri.substr(0, 5), "data:");
}

/// Value of every character of base64, those for file names included; 64: none.
inline std::array<unsigned char, 256> base64_values() {
    std::array<unsigned char, 256> values{};
    values.fill(64);
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
        values[static_cast<unsigned char>(digits[i])] = static_cast<unsigned char>(i);
    values['-'] = 62;
    values['_'] = 63;
    return values;
}

/// Bytes of base64 text. Line ends and blanks are passed over; padding may be missing.
/// @throws Error(invalid_input)
inline Bytes from_base64(std::string_view text, const std::string& place) {
    static const std::array<unsigned char, 256> values = base64_values();
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    unsigned int bits = 0;
    unsigned int count = 0;
    while (!text.empty() && (text.back() == '=' || text.back() == ' ')) text.remove_suffix(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const unsigned int value = values[static_cast<unsigned char>(text[i])];
        if (value == 64) {
            if (text[i] == '\n' || text[i] == '\r' || text[i] == ' ' || text[i] == '\t') continue;
            gltf_fail(place, "its data URI is broken (character " + std::to_string(i) +
                                 " is none of base64); repair or export it again");
        }
        bits = bits << 6 | value;
        if (++count % 4 == 0) {
            bytes.push_back(static_cast<unsigned char>(bits >> 16));
            bytes.push_back(static_cast<unsigned char>(bits >> 8));
            bytes.push_back(static_cast<unsigned char>(bits));
        }
    }
    const unsigned int rest = count % 4;
    if (rest == 1)
        gltf_fail(place,
                  "its data URI is broken (it ends inside of a byte); repair or export it "
                  "again");
    if (rest >= 2) bytes.push_back(static_cast<unsigned char>(bits >> (rest == 2 ? 4 : 10)));
    if (rest == 3) bytes.push_back(static_cast<unsigned char>(bits >> 2));
    return bytes;
}

/// The bytes that a data URI holds, as base64 or percent-encoded, whatever type it names.
/// @pre is_data_uri(uri)
/// @throws Error(invalid_input)
/// Source: RFC 2397.
inline Bytes data_uri_bytes(std::string_view uri, const std::string& place) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        gltf_fail(place,
                  "its data URI has no comma, behind which the data stand; repair or export "
                  "it again");
    constexpr std::string_view base64 = ";base64";
    std::string_view kind = uri.substr(0, comma);
    while (!kind.empty() && kind.back() == ' ') kind.remove_suffix(1);
    const std::string_view data = uri.substr(comma + 1);
    const bool is_base64 = kind.size() >= base64.size() &&
                           equals_in_any_case(kind.substr(kind.size() - base64.size()), base64);
    if (is_base64 && data.find('%') == std::string_view::npos) return from_base64(data, place);
    const std::string plain = unescaped(data);
    if (is_base64) return from_base64(plain, place);
    return {plain.begin(), plain.end()};
}

}  // namespace mir::detail
