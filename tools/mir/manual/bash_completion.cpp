// SPDX-License-Identifier: MIT
#include "manual/pages.hpp"
#include "manual/scene_names.hpp"

#include <CLI/CLI.hpp>

namespace mirtool {
namespace {

/// The words that choose an option of a command: 'render --output' | 'render -o'.
std::string bash_pattern(const CommandFacts& command, const ArgumentFacts& option) {
    std::string text;
    for (const std::string& name : option.names)
        text += (text.empty() ? "'" : " | '") + command.own_name() + " " + name + "'";
    return text;
}

/// What may stand behind an option: one branch of a case.
std::string bash_value(const CommandFacts& command, const ArgumentFacts& option) {
    std::string action;
    if (option.takes_file()) action = "_mir_files; ";
    if (!option.choices.empty()) {
        const std::string words = "'" + CLI::detail::join(option.choices, " ") + "'";
        action = (option.is_list ? "_mir_list " : "_mir_words ") + words + "; ";
    }
    return "    " + bash_pattern(command, option) + ") " + action + "return ;;\n";
}

std::string bash_values(const CommandFacts& program) {
    std::string text;
    for (const CommandFacts& command : program.commands)
        for (const OptionGroup& group : command.groups)
            for (const ArgumentFacts& option : group.options)
                if (!option.value.empty()) text += bash_value(command, option);
    return text;
}

std::string bash_options(const CommandFacts& command) {
    std::string text;
    for (const OptionGroup& group : command.groups)
        for (const ArgumentFacts& option : group.options)
            text += (text.empty() ? "" : " ") + option.name();
    return text;
}

std::string bash_place(const CommandFacts& command) {
    if (command.places.empty()) return ":";
    const ArgumentFacts& place = command.places.front();
    if (place.value == "SCENE") return "_mir_scene";
    if (place.takes_file()) return "_mir_files";
    return "_mir_words '" + CLI::detail::join(place.choices, " ") + "'";
}

std::string bash_commands(const CommandFacts& program) {
    std::string text;
    for (const CommandFacts& command : program.commands)
        text += "    " + command.own_name() + ") options='" + bash_options(command) +
                "'; place=\"" + bash_place(command) + "\" ;;\n";
    return text;
}

std::string command_names(const CommandFacts& program, const char* between) {
    std::string text;
    for (const CommandFacts& command : program.commands)
        text += (text.empty() ? "" : between) + command.own_name();
    return text;
}

constexpr const char* bash_helpers = R"(
_mir_words() { COMPREPLY=($(compgen -W "$1" -- "$current")); }

# The last of several words that commas separate.
_mir_list() {
    local front=
    [[ $current == *,* ]] && front=${current%,*},
    COMPREPLY=($(compgen -P "$front" -W "$1" -- "${current##*,}"))
    compopt -o nospace 2>/dev/null
}

_mir_files() {
    local IFS=$'\n'
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$current"))
}

# A colon ends a word in bash: "builtin:name" is three of them.
_mir_scene() {
    local last=$COMP_CWORD
    [[ $current == : ]] && last=$((last + 1)) && current=
    if [[ ${COMP_WORDS[last - 1]} == : && ${COMP_WORDS[last - 2]} == builtin ]]; then
        _mir_words "$_mir_scenes"
    else
        _mir_files
        if [[ -n $current && builtin: == "$current"* ]]; then
            COMPREPLY+=(builtin:)
            compopt -o nospace 2>/dev/null
        fi
    fi
}
)";

}  // namespace

std::string bash_completion(const CommandFacts& program) {
    std::string text = "# Completion of mir in bash, written by \"mir manual bash\".\n";
    text += "_mir_scenes='" + scene_names(" ") + "'\n" + bash_helpers;
    text += R"(
_mir() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local command= options= place= i
    COMPREPLY=()
    # So does an equals sign: "--option=value" is three words, too.
    if [[ $current == = ]]; then
        current=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case ${COMP_WORDS[i]} in
)";
    text += "        " + command_names(program, " | ") + ") command=${COMP_WORDS[i]}; break ;;\n";
    text += "        esac\n    done\n    case \"$command $before\" in\n";
    text += bash_values(program) + "    esac\n    case $command in\n";
    text += bash_commands(program);
    text += "    *) options='" + bash_options(program) + "'; place=\"_mir_words '" +
            command_names(program, " ") + "'\" ;;\n";
    return text + R"(    esac
    if [[ $current == -* ]]; then
        _mir_words "$options"
    else
        eval "$place"
    fi
}
complete -F _mir mir
)";
}

}  // namespace mirtool
