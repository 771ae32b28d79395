// SPDX-License-Identifier: MIT
#include "manual/help.hpp"

#include <algorithm>

namespace mirtool {
namespace {

constexpr std::size_t help_columns = 80;
constexpr std::size_t words_column = 26;  ///< column where explanations begin

/// `words` in lines from `words_column` on, the first behind `front`.
std::string explained(const std::string& front, const std::string& words) {
    const std::string margin(words_column, ' ');
    std::string text;
    std::string line = front;
    if (line.size() + 2 > words_column && !words.empty()) {
        text = line + "\n";
        line.clear();
    }
    line.resize(std::max(line.size(), words_column), ' ');
    bool is_first = true;
    for (std::size_t begin = 0; begin < words.size();) {
        // What stands in brackets stays together.
        const std::size_t from = words[begin] == '[' ? words.find(']', begin) : begin;
        const std::size_t end = std::min(words.find(' ', from), words.size());
        if (!is_first && line.size() + 1 + end - begin > help_columns) {
            text += line + "\n";
            line = margin;
            is_first = true;
        }
        line += (is_first ? "" : " ") + words.substr(begin, end - begin);
        is_first = false;
        begin = end + 1;
    }
    return text + line + "\n";
}

std::string front_of_option(const ArgumentFacts& option) {
    std::string text = "  " + CLI::detail::join(option.names, ", ");
    return option.value.empty() ? text : text + " " + option.value;
}

/// `with_condition`: with the range of its number and the like.
std::string help_of_option(const ArgumentFacts& option, bool with_condition) {
    std::string words = option.words;
    if (with_condition && !option.condition.empty()) words += " [" + option.condition + "]";
    return explained(front_of_option(option), words);
}

std::string help_of_places(const CommandFacts& command) {
    std::string text;
    for (const ArgumentFacts& place : command.places)
        text += explained("  " + place.name(), place.words);
    return text.empty() ? text : "\n" + text;
}

std::string help_of_commands(const CommandFacts& program) {
    if (program.commands.empty()) return "";
    std::string text = "\nCommands:\n";
    for (const CommandFacts& command : program.commands)
        text += explained("  " + command.own_name(), command.words);
    return text;
}

/// The options among `first`, or all where there is none.
std::string help_of_groups(const CommandFacts& command, const std::vector<std::string>& first) {
    std::string text;
    std::size_t hidden = 0;
    for (const OptionGroup& group : command.groups) {
        std::string options;
        for (const ArgumentFacts& option : group.options)
            if (first.empty() ||
                std::find(first.begin(), first.end(), option.name()) != first.end())
                options += help_of_option(option, first.empty());
            else
                ++hidden;
        if (!options.empty()) text += "\n" + group.title + ":\n" + options;
    }
    if (hidden == 0) return text;
    return text + "\n" + std::to_string(hidden) + " more options: " + command.name +
           " --help-all\n";
}

std::string help_of(const CommandFacts& command, const std::vector<std::string>& first) {
    std::string text = command.words + "\n\nUsage: " + command.usage() + "\n" +
                       help_of_places(command) + help_of_commands(command) +
                       help_of_groups(command, first);
    if (!command.footer.empty()) text += "\n" + command.footer + "\n";
    return text;
}

}  // namespace

std::string Help::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    const bool all = mode != CLI::AppFormatMode::Normal;
    CommandFacts facts = facts_of(*app);
    facts.name = std::move(name);
    std::string text = help_of(facts, all ? std::vector<std::string>() : first_);
    if (!all) return text;
    for (const CommandFacts& command : facts.commands)
        text += "\n\n" + command.name + ": " + help_of(command, {});
    return text;
}

}  // namespace mirtool
