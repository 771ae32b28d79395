// SPDX-License-Identifier: MIT
#include "mir/core/printable.hpp"

#include "mir/core/error.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>

namespace {

using mir::printable;

/// UTF-8 of any number of 21 bits, surrogates too.
std::string utf8(std::uint32_t code) {
    const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
    if (code < 0x80) return {byte(code)};
    if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 0x3f))};
    if (code < 0x10000)
        return {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 0x3f)),
                byte(0x80 | (code & 0x3f))};
    return {byte(0xf0 | code >> 18), byte(0x80 | (code >> 12 & 0x3f)),
            byte(0x80 | (code >> 6 & 0x3f)), byte(0x80 | (code & 0x3f))};
}

std::string hex(std::uint32_t value, int digits) {
    char text[16];
    std::snprintf(text, sizeof text, "%0*x", digits, value);
    return text;
}

/// Each byte as an escape.
std::string bytes_shown(const std::string& bytes) {
    std::string shown;
    for (const char c : bytes) shown += "\\x" + hex(static_cast<unsigned char>(c), 2);
    return shown;
}

const std::set<std::uint32_t> unseen = {0x61c,  0x200e, 0x200f, 0x2028, 0x2029, 0x202a, 0x202b,
                                        0x202c, 0x202d, 0x202e, 0x2066, 0x2067, 0x2068, 0x2069};

}  // namespace

TEST_CASE("every single byte is shown as itself or as an escape") {
    for (std::uint32_t b = 0; b < 256; ++b) {
        const std::string text(1, static_cast<char>(b));
        std::string shown = "\\x" + hex(b, 2);
        if (b >= 0x20 && b < 0x7f) shown = text;
        if (b == '\n') shown = "\\n";
        if (b == '\t') shown = "\\t";
        if (b == '\r') shown = "\\r";
        INFO(b);
        CHECK(printable(text) == shown);
        CHECK(printable("a" + text + "b") == "a" + shown + "b");
    }
}

TEST_CASE("every character stays but for controls, which are named") {
    std::size_t wrong = 0;
    for (std::uint32_t code = 0x80; code <= 0x10ffff; ++code) {
        if (code == 0xd800) code = 0xe000;
        const bool hidden = code < 0xa0 || unseen.contains(code);
        const std::string text = utf8(code);
        wrong += printable(text) != (hidden ? "\\u" + hex(code, 4) : text) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(printable("\x1b[31mred\x1b[0m") == "\\x1b[31mred\\x1b[0m");
    CHECK(printable("a\xe2\x80\xae"
                    "b") == "a\\u202eb");
}

TEST_CASE("what is no UTF-8 is shown byte by byte") {
    for (std::uint32_t code = 0xd800; code < 0xe000; ++code)
        if (printable(utf8(code)) != bytes_shown(utf8(code))) FAIL(code);
    for (const std::string text :
         {"\xc0\x80", "\xc0\x9b", "\xc1\xbf", "\xe0\x80\x9b", "\xe0\x9f\xbf", "\xf0\x80\x80\x9b",
          "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xf8\x88\x80\x80\x80",
          "\x80", "\xbf\xbf", "\xfe\xff"})
        CHECK(printable(text) == bytes_shown(text));
    // Cut characters, at the end and before others.
    for (const std::uint32_t code : {0xe4u, 0x20acu, 0x202eu, 0x1f600u}) {
        const std::string whole = utf8(code);
        for (std::size_t n = 1; n < whole.size(); ++n) {
            const std::string part = whole.substr(0, n);
            CHECK(printable(part) == bytes_shown(part));
            CHECK(printable(part + "a") == bytes_shown(part) + "a");
            CHECK(printable(part + utf8(0xe4)) == bytes_shown(part) + utf8(0xe4));
        }
    }
}

namespace {

/// `count` times `text`.
std::string repeated(const std::string& text, std::size_t count) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
}

/// What printable() makes of `count` times a character, which it shows as `one`: all of it, or as
/// many as fit before an ending that says how long it is.
void check_cut(const std::string& character, const std::string& one, std::size_t count,
               std::size_t longest) {
    const std::string text = repeated(character, count);
    const std::string all = repeated(one, count);
    const std::string shown = printable(text, longest);
    if (all.size() <= longest) {
        if (shown != all) FAIL(shown);
        return;
    }
    const std::string ending = "... (" + std::to_string(text.size()) + " bytes)";
    if (!shown.ends_with(ending)) FAIL(shown);
    const std::string front = shown.substr(0, shown.size() - ending.size());
    const bool whole = front.size() % one.size() == 0 && all.starts_with(front);
    const bool fits = shown.size() <= std::max(longest, ending.size());
    const bool most = shown.size() + one.size() > longest;
    if (!whole || !fits || !most) FAIL(shown << ", " << longest);
}

}  // namespace

TEST_CASE("long text is cut between characters and says how long it is") {
    CHECK(printable(std::string(200, 'a')) == std::string(200, 'a'));
    CHECK(printable(std::string(201, 'a')) == std::string(185, 'a') + "... (201 bytes)");
    CHECK(printable(std::string(5'000'000, '\n'), 25) == "\\n\\n\\n... (5000000 bytes)");
    for (const std::string character :
         {"a", "\n", "\x1b", "\xff", "\xc3\xa4", "\xe2\x80\xae", "\xf0\x9f\x98\x80"}) {
        const std::string one = printable(character);
        for (std::size_t count : {0u, 1u, 7u, 30u, 100u, 1000u})
            for (std::size_t longest = 0; longest < 300; ++longest)
                check_cut(character, one, count, longest);
    }
}

TEST_CASE("what is printable stays") {
    std::string text;
    for (std::uint32_t b = 0; b < 256; ++b) text += static_cast<char>(b);
    for (const std::uint32_t code : unseen) text += utf8(code);
    for (const std::size_t longest : {20u, 100u, 200u, 1000u, 5000u}) {
        const std::string once = printable(text, longest);
        CHECK(printable(once, longest) == once);
        CHECK(printable(once, 5000) == once);
    }
    const std::string plain = "C:\\new\\table 'x' \"y\" \xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80";
    CHECK(printable(plain) == plain);
    CHECK(printable("").empty());
    CHECK(printable("", 0).empty());
}

TEST_CASE("the message of an error can be printed") {
    const mir::Error error(mir::ErrorCode::internal, "mesh '\x1b]0;x\a\xff': \n\xe2\x80\xae");
    CHECK(std::string(error.what()) == "mesh '\\x1b]0;x\\x07\\xff': \\n\\u202e");
    const std::string endless(1 << 20, 'x');
    CHECK(std::string(mir::Error(mir::ErrorCode::io, endless).what()).size() <= 2000);
}
