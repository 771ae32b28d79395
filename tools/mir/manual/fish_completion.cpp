// SPDX-License-Identifier: MIT
#include "manual/brief.hpp"
#include "manual/pages.hpp"
#include "manual/scene_names.hpp"

#include <CLI/CLI.hpp>

namespace mirtool {
namespace {

std::string fish_quoted(const std::string& text) {
    std::string to;
    for (const char c : text) {
        if (c == '\'' || c == '\\') to += '\\';
        to += c;
    }
    return "'" + to + "'";
}

/// What stands behind it: nothing, one of some words, a file.
std::string fish_value(const ArgumentFacts& argument) {
    if (argument.value.empty()) return "";
    const std::string words = CLI::detail::join(argument.choices, " ");
    if (!words.empty()) return " -x -a " + fish_quoted(words);
    if (argument.value == "SCENE") return " -F -a " + fish_quoted(scene_names(" ", "builtin:"));
    return argument.takes_file() ? " -r -F" : " -x";
}

/// `when`: where the options are offered.
std::string fish_options(const CommandFacts& command, const std::string& when) {
    std::string text;
    for (const OptionGroup& group : command.groups)
        for (const ArgumentFacts& option : group.options) {
            text += when;
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            text += fish_value(option) + " -d " + fish_quoted(brief(option.words)) + "\n";
        }
    return text;
}

}  // namespace

std::string fish_completion(const CommandFacts& program) {
    const std::string before = "complete -c mir -n __fish_use_subcommand";
    std::string text = "# Completion of mir in fish, written by \"mir manual fish\".\n";
    text += "complete -c mir -f\n" + fish_options(program, before);
    for (const CommandFacts& command : program.commands) {
        const std::string name = command.own_name();
        text.append(before).append(" -a ").append(name).append(" -d ");
        text.append(fish_quoted(command.words)).append("\n");
        const std::string when = "complete -c mir -n '__fish_seen_subcommand_from " + name + "'";
        text += fish_options(command, when);
        if (!command.places.empty()) text += when + fish_value(command.places.front()) + "\n";
    }
    return text;
}

}  // namespace mirtool
