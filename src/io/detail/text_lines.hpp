// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/check_input.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace mir::detail {

/// Calls `use` with every word of `line`.
template <class Use>
void for_each_word(std::string_view line, const Use& use) {
    constexpr std::string_view blanks = " \t";
    std::size_t at = line.find_first_not_of(blanks);
    while (at != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
        use(line.substr(at, end - at));
        at = line.find_first_not_of(blanks, end);
    }
}

/// `text` without blanks at its ends.
inline std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\n");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\n") + 1 - first));
}

/// The first word of `line`; empty for comments and empty lines.
inline std::string_view keyword_of(std::string_view line) {
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    line.remove_prefix(first);
    if (line.starts_with('#')) return {};
    return line.substr(0, line.find_first_of(" \t"));
}

/// Ends every line with '\n' alone.
/// @throws Error(invalid_input) on a byte that no text has.
inline std::string plain_lines(std::string text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool last = i + 1 == text.size();
        if (text[i] == '\0')
            fail_at("byte " + std::to_string(i),
                    "it is zero (so the file is no text); export it as text");
        if (text[i] == '\r') text[i] = !last && text[i + 1] == '\n' ? ' ' : '\n';
    }
    return text;
}

}  // namespace mir::detail
