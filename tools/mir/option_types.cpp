// SPDX-License-Identifier: MIT
#include "option_types.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

namespace mirtool {
namespace {

/// Why CLI11 would not read a number as meant; empty when it would. It takes whole ones that begin
/// with a zero for octal ones, or others.
std::string misread(const std::string& value) {
    const std::size_t sign = !value.empty() && (value[0] == '-' || value[0] == '+') ? 1 : 0;
    const bool has_zero = value.size() > sign + 1 && value[sign] == '0';
    if (!has_zero || std::isalnum(static_cast<unsigned char>(value[sign + 1])) == 0) return "";
    return "'" + value + "' begins with a zero, which some take for octal; leave the zero out";
}

}  // namespace

void begin_group(CLI::App& app, const std::string& title) { app.option_defaults()->group(title); }

CLI::Validator between(double low, double high, const std::string& text,
                       const std::string& why_not_less) {
    return {[=](std::string& value) {
                if (std::string why = misread(value); !why.empty()) return why;
                double number = 0.0;
                if (!CLI::detail::lexical_cast(value, number))
                    return "'" + value + "' is no number";
                if (number >= low && number <= high) return std::string();
                const bool needs_reason = !why_not_less.empty() && !(number > high);
                return value + " is out of range" +
                       (needs_reason ? " (" + why_not_less + ")" : "") + "; give " + text;
            },
            text};
}

CLI::Validator seed_number() {
    return {[](std::string& value) {
                if (std::string why = misread(value); !why.empty()) return why;
                std::uint64_t number = 0;
                if (read_whole(value, number)) return std::string();
                return "'" + value + "' is no seed; give 0 to 18446744073709551615";
            },
            "0 to 2^64-1"};
}

std::optional<mir::DVec3> read_vector(const std::string& text) {
    mir::DVec3 v(0.0);
    std::size_t begin = 0;
    for (int k = 0; k < 3; ++k) {
        const std::size_t end = k < 2 ? text.find(',', begin) : text.size();
        if (end == std::string::npos || !read_whole(text.substr(begin, end - begin), v[k]) ||
            !std::isfinite(static_cast<float>(v[k])))
            return std::nullopt;
        begin = end + 1;
    }
    return v;
}

CLI::Option* add_words(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                       const std::vector<std::string>& words, const std::string& help) {
    const std::string names = CLI::detail::join(words, "|");
    return app.add_option(name, target, help)
        ->delimiter(',')
        ->check(CLI::Validator(
            [words, names](const std::string& word) {
                return std::find(words.begin(), words.end(), word) != words.end()
                           ? std::string()
                           : "'" + word + "' is unknown; choose some of " + names;
            },
            ""))
        ->type_name(names);
}

CLI::Option* add_vector(CLI::App& app, const std::string& name, std::optional<mir::DVec3>& target,
                        const std::string& help) {
    return app
        .add_option_function<std::string>(
            name,
            [&target, name](const std::string& text) {
                target = read_vector(text);
                if (!target)
                    throw CLI::ValidationError(
                        name, "'" + text + "' is no vector; give three numbers, such as 1,2.5,0");
            },
            help)
        ->type_name("X,Y,Z");
}

}  // namespace mirtool
