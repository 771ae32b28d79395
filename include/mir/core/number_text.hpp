// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace mir {
namespace detail {

inline std::string print_number(double value, std::chars_format format, int precision) {
    std::array<char, 512> text{};  // the largest double has 309 digits before its point
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, format, precision);
    return {text.data(), end.ptr};
}

}  // namespace detail

/// A number in up to `digits` digits, at most 100, like "%.6g". As in the locale "C", whatever
/// locale the program has chosen: with a point and without groups. 17 tell every double, 9 every
/// float.
inline std::string number_text(double value, int digits = 6) {
    return detail::print_number(value, std::chars_format::general, digits);
}

/// A number with so many digits behind the point, at most 100. As "%.2f" writes it in the locale
/// "C".
inline std::string fixed_text(double value, int digits = 0) {
    return detail::print_number(value, std::chars_format::fixed, digits);
}

/// A number in the fewest characters that identify the double, in any
/// locale.
inline std::string shortest_text(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

}  // namespace mir
