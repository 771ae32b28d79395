// SPDX-License-Identifier: MIT
#include "exit_code.hpp"
#include "manual/pages.hpp"
#include "mir/version.hpp"

#include <cctype>

namespace mirtool {
namespace {

/// Text as man(7) takes it: hyphens that can be copied, no line that looks like a request.
std::string man_text(const std::string& text) {
    std::string to;
    for (const char c : text) {
        if (to.empty() || to.back() == '\n') to += c == '.' || c == '\'' ? "\\&" : "";
        if (c == '\\')
            to += "\\e";
        else if (c == '-')
            to += "\\-";
        else
            to += c;
    }
    return to;
}

std::string man_bold(const std::string& text) { return "\\fB" + man_text(text) + "\\fR"; }

std::string capitals(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string man_argument(const ArgumentFacts& argument) {
    std::string text = ".TP\n";
    for (const std::string& name : argument.names)
        text += (name == argument.names.front() ? "" : ", ") + man_bold(name);
    const bool has_value = !argument.value.empty() && argument.name().starts_with('-');
    if (has_value) text += " \\fI" + man_text(argument.value) + "\\fR";
    text += "\n" + man_text(argument.words) + ".\n";
    if (!argument.condition.empty()) text += "[" + man_text(argument.condition) + "]\n";
    return text;
}

std::string man_groups(const CommandFacts& command) {
    std::string text;
    for (const OptionGroup& group : command.groups) {
        text += ".SS \"" + man_text(group.title) + "\"\n";
        for (const ArgumentFacts& option : group.options) text += man_argument(option);
    }
    return text;
}

std::string man_command(const CommandFacts& command) {
    std::string text = ".SH \"" + capitals(command.name) + "\"\n" + man_text(command.words) +
                       ".\n" + ".PP\n" + man_bold(command.usage()) + "\n";
    for (const ArgumentFacts& place : command.places) text += man_argument(place);
    return text + man_groups(command);
}

std::string synopsis(const CommandFacts& program) {
    std::string text = ".SH SYNOPSIS\n.nf\n";
    for (const CommandFacts& command : program.commands) text += man_bold(command.usage()) + "\n";
    return text + ".fi\n";
}

std::string exit_status() {
    std::string text = ".SH \"EXIT STATUS\"\n";
    for (const ExitMeaning& e : exit_meanings)
        text += ".TP\n" + man_bold(std::to_string(e.code)) + "\n" + man_text(e.words) + ".\n";
    return text;
}

}  // namespace

std::string man_page(const CommandFacts& program) {
    std::string text = ".\\\" Written by \"mir manual man\".\n.TH MIR 1 \"\" \"mir " +
                       std::string(mir::version) + "\" \"User Commands\"\n.nh\n.ad l\n";
    text += ".SH NAME\nmir \\- " + man_text(program.words) + "\n" + synopsis(program);
    text += ".SH DESCRIPTION\n";
    text += man_text(
        "mir renders scenes of glTF, OBJ and PLY files, or scenes that it makes itself, with "
        "virtual point lights (VPLs) that Metropolis sampling places where they matter to the "
        "image. Pictures are OpenEXR, linear, with a PNG beside them as a preview.\n");
    text +=
        ".PP\nEvery command has " + man_bold("--help") + " and " + man_bold("--help-all") + ".\n";
    text += man_groups(program);
    for (const CommandFacts& command : program.commands) text += man_command(command);
    text += exit_status();
    // Behind the title that stands over them.
    const std::string examples = program.footer.substr(program.footer.find('\n') + 1);
    return text + ".SH EXAMPLES\n.nf\n" + man_text(examples) + "\n.fi\n";
}

}  // namespace mirtool
