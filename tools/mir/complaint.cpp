// SPDX-License-Identifier: MIT
#include "complaint.hpp"

#include "nearest.hpp"

namespace mirtool {
namespace {

/// The word to complain about: an option rather than the value behind it.
std::string worst_of(const std::vector<std::string>& strangers) {
    for (const std::string& word : strangers)
        if (word.starts_with('-')) return word;
    return strangers.back();
}

/// What is wrong where no command is named, or one that there is not.
std::string without_command(const CLI::App& app, const std::vector<std::string>& strangers) {
    if (!strangers.empty() && strangers.front().starts_with('-'))
        return "unknown argument '" + strangers.front() + "'";
    std::string commands;
    for (const CLI::App* command : app.get_subcommands({}))
        commands += (commands.empty() ? "" : ", ") + command->get_name();
    return (strangers.empty() ? "no command is given"
                              : "unknown command '" + strangers.front() + "'") +
           " (commands are " + commands + ")";
}

}  // namespace

const CLI::App& used_command(const CLI::App& app) {
    const CLI::App* used = &app;
    for (const CLI::App* sub : app.get_subcommands()) used = sub;
    return *used;
}

std::string complaint(const CLI::App& app, const CLI::ParseError& e) {
    const CLI::App& used = used_command(app);
    // What no command knows may stand before the command that is used.
    const std::vector<std::string> strangers = app.remaining(true);
    const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr;
    std::string text = unknown ? "unknown argument '" + worst_of(strangers) + "'" : e.what();
    if (&used == &app && dynamic_cast<const CLI::RequiredError*>(&e) != nullptr)
        text = without_command(app, strangers);
    std::vector<std::string> known;
    for (const CLI::Option* option : used.get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const CLI::App* sub : used.get_subcommands({})) known.push_back(sub->get_name());
    for (const std::string& word : strangers)
        if (const auto guess = nearest(word.substr(0, word.find('=')), known))
            text += "; did you mean " + *guess + "?";
    return text;
}

}  // namespace mirtool
