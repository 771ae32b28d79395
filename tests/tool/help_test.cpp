// SPDX-License-Identifier: MIT
#include "tool/help_text.hpp"

#include <algorithm>
#include <sstream>

using namespace mirtest;

namespace {

std::size_t options_in(const std::map<std::string, Words>& groups) {
    std::size_t count = 0;
    for (const auto& [title, options] : groups) count += options.size();
    return count;
}

/// Without line ends and margins.
std::string in_one_line(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) line += word + " ";
    return line;
}

std::string help_of(const Words& command) {
    const Outcome help = run_mir(command);
    CHECK(help.exit_code == 0);
    CHECK(help.err.empty());
    return help.out;
}

}  // namespace

TEST_CASE("the help of render shows a dozen options, and --help-all shows all") {
    const auto first = groups_of(help_of({"render", "--help"}));
    const auto all = groups_of(help_of({"render", "--help-all"}));
    CHECK(options_in(first) >= 10);
    CHECK(options_in(first) <= 16);
    CHECK(options_in(all) > 70);
    for (const auto& [title, options] : first)
        for (const std::string& option : options) {
            INFO(title << " " << option);
            REQUIRE(all.contains(title));
            CHECK(std::find(all.at(title).begin(), all.at(title).end(), option) !=
                  all.at(title).end());
        }
    for (const char* option : {"--output", "--width", "--vpls", "--aov", "--backend", "--help-all"})
        CHECK(has(help_of({"render", "--help"}), option));
    CHECK_FALSE(has(help_of({"render", "--help"}), "--prepass-luxels"));
}

TEST_CASE("no title of the help of render stands over a single option") {
    for (const char* help : {"--help", "--help-all"})
        for (const auto& [title, options] : groups_of(help_of({"render", help}))) {
            INFO(help << " " << title);
            CHECK(title.size() < 50);
            CHECK(options.size() >= 2);
        }
}

TEST_CASE("lines of help have at most 80 columns") {
    Words helps;
    for (const std::string& command : tool_commands)
        for (const char* help : {"--help", "--help-all"}) helps.push_back(help_of({command, help}));
    helps.push_back(help_of({"--help"}));
    helps.push_back(help_of({"--help-all"}));
    for (const std::string& help : helps)
        for (const std::string& line : lines_of(help)) {
            INFO(line);
            CHECK(line.size() <= 80);
            CHECK_FALSE(line.ends_with(' '));
        }
}

TEST_CASE("the help of all commands is that of each") {
    const std::string all = help_of({"--help-all"});
    for (const std::string& command : tool_commands) {
        CHECK(has(all, "\nmir " + command + ": "));
        for (const std::string& option : options_of(command)) CHECK(has(all, " " + option));
    }
}

TEST_CASE("help tells defaults and ranges in words") {
    const std::string all = in_one_line(help_of({"render", "--help-all"}));
    CHECK(has(all, "albedo, normal and depth"));
    CHECK(has(all, "[1 to 65536]"));
    CHECK(has(all, "with --sun]"));
    for (const char* name_of_a_type : {"UINT", "FLOAT", "TEXT", "Needs:", "Excludes:", "{"}) {
        INFO(name_of_a_type);
        CHECK_FALSE(has(all, name_of_a_type));
    }
}
