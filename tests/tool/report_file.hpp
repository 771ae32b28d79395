// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/html_text.hpp"
#include "support/inflate_radiance.hpp"
#include "tool/mir_program.hpp"

#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace mirtest {

/// What the first group of `pattern` matches, each time.
inline Words all_matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    Words found;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i)
        found.push_back((*i)[1].str());
    return found;
}

inline std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++n;
    return n;
}

/// The text from behind `begin` up to `end`; empty when either is missing.
inline std::string between(const std::string& text, const std::string& begin,
                           const std::string& end) {
    const std::size_t from = text.find(begin);
    if (from == std::string::npos) return "";
    const std::size_t to = text.find(end, from + begin.size());
    if (to == std::string::npos) return "";
    return text.substr(from + begin.size(), to - from - begin.size());
}

inline std::vector<std::uint8_t> from_base64(const std::string& text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    std::uint32_t bits = 0;
    int have = 0;
    for (const char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<std::uint32_t>(letters.find(c));
        have += 6;
        if (have < 8) continue;
        have -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> have));
    }
    return bytes;
}

/// A layer of a report, by its name, with the size that its canvas has.
inline mir::Image<mir::Rgb> layer_of(const std::string& page, const std::string& name) {
    const std::string canvas = between(page, "<canvas", ">");
    const auto side = [&](const char* which) {
        return static_cast<std::uint32_t>(
            std::stoul(between(canvas, std::string(" ") + which + "=\"", "\"")));
    };
    const std::string code =
        between(page, R"(<script type="application/octet-stream" id=")" + name + "\">", "<");
    return inflate_radiance(from_base64(code), {side("width"), side("height")});
}

/// The page without its style, its script and the bytes of pictures: what its text holds.
inline std::string markup_of(const std::string& page) {
    std::string markup;
    for (std::size_t at = 0; at < page.size();) {
        const std::size_t style = page.find("<style>", at);
        const std::size_t script = page.find("<script", at);
        const std::size_t skipped = std::min(style, script);
        markup += page.substr(at, skipped - at);
        if (skipped == std::string::npos) break;
        at = page.find(skipped == style ? "</style>" : "</script>", skipped);
    }
    return markup;
}

}  // namespace mirtest
