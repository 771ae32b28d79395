// SPDX-License-Identifier: MIT
#include "manual/brief.hpp"
#include "manual/pages.hpp"
#include "manual/scene_names.hpp"

#include <CLI/CLI.hpp>

namespace mirtool {
namespace {

/// A text in brackets inside single quotes.
std::string zsh_quoted(const std::string& text) {
    std::string to;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') to += '\\';
        if (c == '\'')
            to += "'\\''";
        else
            to += c;
    }
    return to;
}

/// What completes a value, as _arguments wants it.
std::string zsh_action(const ArgumentFacts& argument) {
    if (argument.value.empty()) return "";
    const std::string words = CLI::detail::join(argument.choices, " ");
    const std::string label = ":" + (words.empty() ? zsh_quoted(argument.value) : "name") + ":";
    if (argument.value == "SCENE") return label + "_mir_scene";
    if (argument.takes_file()) return label + "_files";
    if (words.empty()) return label + " ";
    return label + (argument.is_list ? "_sequence compadd - " + words : "(" + words + ")");
}

std::string zsh_options(const CommandFacts& command) {
    std::string text;
    for (const OptionGroup& group : command.groups)
        for (const ArgumentFacts& option : group.options)
            for (const std::string& name : option.names)
                text += " \\\n            '(" + CLI::detail::join(option.names, " ") + ")" + name +
                        (name.starts_with("--") && !option.value.empty() ? "=" : "") + "[" +
                        zsh_quoted(brief(option.words)) + "]" + zsh_action(option) + "'";
    return text;
}

std::string zsh_branch(const CommandFacts& command) {
    std::string text = "        " + command.own_name() + ")\n        _arguments -s";
    text += zsh_options(command);
    for (const ArgumentFacts& place : command.places)
        text += " \\\n            '" + zsh_action(place) + "'";
    return text + "\n        ;;\n";
}

}  // namespace

std::string zsh_completion(const CommandFacts& program) {
    std::string text = "#compdef mir\n# Completion of mir in zsh, written by \"mir manual zsh\".\n";
    text += "_mir_scene() {\n    _files\n    compadd -- " + scene_names(" ", "builtin:") + "\n}\n";
    text += "_mir() {\n    local curcontext=$curcontext state line\n    local -a commands\n";
    text += "    commands=(\n";
    for (const CommandFacts& command : program.commands)
        text += "        '" + command.own_name() + ":" + zsh_quoted(command.words) + "'\n";
    text += "    )\n    _arguments -C" + zsh_options(program);
    text += " \\\n            '1: :->command' '*:: :->arguments'\n    case $state in\n";
    text += "    command) _describe command commands ;;\n    arguments)\n";
    text += "        case $words[1] in\n";
    for (const CommandFacts& command : program.commands) text += zsh_branch(command);
    return text + "        esac\n        ;;\n    esac\n}\n_mir \"$@\"\n";
}

}  // namespace mirtool
