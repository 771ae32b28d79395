// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/check_input.hpp"
#include "mir/core/printable.hpp"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace mir::detail {

/// The number that `token` begins with, and the characters behind it. In the notation of C without
/// hexadecimals.
struct LeadingNumber {
    double value = 0.0;
    std::string_view rest;
};

/// Nothing when `token` begins with no number. "nan" and "inf" are read as such; a number too
/// large for a double as infinite.
inline std::optional<LeadingNumber> leading_number(std::string_view token) {
    const char* first = token.data();
    const char* end = first + token.size();
    // from_chars knows no plus sign.
    if (token.size() > 1 && token[0] == '+' && token[1] != '-') ++first;
    double value = 0.0;
    const auto read = std::from_chars(first, end, value);
    if (read.ec == std::errc::invalid_argument) return std::nullopt;
    if (read.ec == std::errc::result_out_of_range) {
        // The number is left alone there: it is too large, or so small that it is nothing.
        const std::string_view digits(first, static_cast<std::size_t>(read.ptr - first));
        const bool tiny = digits.find("e-") != std::string_view::npos ||
                          digits.find("E-") != std::string_view::npos;
        value = tiny ? 0.0 : HUGE_VAL;
    }
    return LeadingNumber{value, {read.ptr, static_cast<std::size_t>(end - read.ptr)}};
}

/// The number that is all of `token`, finite and within 32 bits.
/// @throws Error(invalid_input)
inline float whole_number_token(std::string_view token, const char* what,
                                const std::string& place) {
    const auto number = leading_number(token);
    if (!number || !number->rest.empty())
        fail_at(place, std::string(what) + " is no number (" + in_quotes(token) +
                           "); repair or export the file again");
    return checked_float(number->value, what, place);
}

}  // namespace mir::detail
