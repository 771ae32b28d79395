// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mirtool {

/// Options that are added from now on stand under this title in the help.
void begin_group(CLI::App& app, const std::string& title);

/// A number within [low, high], which `text` says in words. CLI11's own check prints bounds with
/// hundreds of digits.
/// `why_not_less` is said of what is less, or no number at all.
CLI::Validator between(double low, double high, const std::string& text,
                       const std::string& why_not_less = "");

/// Any number of 64 bits; CLI11 2.1 lets others wrap around.
CLI::Validator seed_number();

/// Reads all of `text` as a number without sign.
template <class T>
bool read_whole(const std::string& text, T& number) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc() && read.ptr == end;
}

/// One of some words, each of which stands for a value.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& target,
                        const std::map<std::string, T>& choices, const std::string& help) {
    std::string names;
    for (const auto& [key, value] : choices) names += (names.empty() ? "" : "|") + key;
    return app
        .add_option_function<std::string>(
            name,
            [&target, choices, name, names](const std::string& text) {
                const auto found = choices.find(text);
                if (found == choices.end())
                    throw CLI::ValidationError(name,
                                               "'" + text + "' is unknown; choose one of " + names);
                target = found->second;
            },
            help)
        ->type_name(names);
}

/// Some words of a list, separated by commas.
CLI::Option* add_words(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                       const std::vector<std::string>& words, const std::string& help);

/// Reads three finite numbers that are separated by commas.
std::optional<mir::DVec3> read_vector(const std::string& text);

/// An option whose value is a point or a direction.
CLI::Option* add_vector(CLI::App& app, const std::string& name, std::optional<mir::DVec3>& target,
                        const std::string& help);

/// A whole number option of a smaller type than int.
template <class T>
CLI::Option* add_count(CLI::App& app, const std::string& name, T& target, int low, int high,
                       const std::string& help) {
    return app
        .add_option_function<int>(
            name, [&target](int n) { target = static_cast<T>(n); }, help)
        ->check(between(low, high, std::to_string(low) + " to " + std::to_string(high)))
        ->type_name("N");
}

}  // namespace mirtool
