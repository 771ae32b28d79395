// SPDX-License-Identifier: MIT
#include "picture_words.hpp"

#include "arguments.hpp"
#include "complaint.hpp"
#include "pass_goal_of.hpp"

#include <algorithm>

namespace mirtool {
namespace {

/// "--vpls" of "--vpls: 0 is out of range", or of "unknown argument '--vpls=3'".
std::string setting_of(const std::string& text) {
    const std::size_t begin = text.find("--");
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_first_of(":=' ", begin) - begin);
}

}  // namespace

RenderOptions read_picture_words(const std::vector<std::string>& words) {
    RenderOptions options;
    CLI::App app;
    app.set_help_flag();
    add_picture(app, options);
    try {
        // CLI11 takes them from the end.
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    } catch (const CLI::ParseError& e) {
        const std::string text = complaint(app, e);
        throw SettingError(text, setting_of(text));
    }
    check(options.passes);
    return options;
}

}  // namespace mirtool
