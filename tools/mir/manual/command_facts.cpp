// SPDX-License-Identifier: MIT
#include "manual/command_facts.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>

namespace mirtool {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(at, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

/// What CLI11 calls numbers, for people.
std::string plain_value(const std::string& type) {
    if (type == "UINT" || type == "INT") return "N";
    return type == "FLOAT" ? "X" : type;
}

void add_condition(std::string& to, const std::string& text) {
    if (!text.empty()) to += (to.empty() ? "" : "; ") + text;
}

/// CLI11 joins the type and what its checks say of themselves with colons.
void read_type(const CLI::Option& option, ArgumentFacts& to) {
    if (option.get_type_size() == 0) return;
    const std::vector<std::string> parts = split(option.get_type_name(), ':');
    to.value = plain_value(parts.front());
    for (std::size_t k = 1; k < parts.size(); ++k) add_condition(to.condition, parts[k]);
    if (to.value.find('|') == std::string::npos) return;
    // Words in capitals stand for something, such as a number.
    for (const std::string& word : split(to.value, '|'))
        if (std::islower(static_cast<unsigned char>(word.front())) != 0) to.choices.push_back(word);
}

ArgumentFacts argument_of(const CLI::Option& option) {
    ArgumentFacts to;
    to.is_required = option.get_required();
    to.words = option.get_description();
    read_type(option, to);
    if (option.get_positional()) {
        to.names = {option.get_name()};
        return to;
    }
    for (const std::string& name : option.get_snames()) to.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) to.names.push_back("--" + name);
    to.is_list = option.get_delimiter() != '\0';
    if (to.is_list) to.value = "NAME,...";
    for (const CLI::Option* other : option.get_needs())
        add_condition(to.condition, "with " + other->get_name());
    for (const CLI::Option* other : option.get_excludes())
        add_condition(to.condition, "not with " + other->get_name());
    return to;
}

std::vector<OptionGroup> groups_of(const CLI::App& app) {
    std::vector<OptionGroup> groups;
    const auto add = [&groups](const CLI::Option& option) {
        const std::string& title = option.get_group();
        if (title.empty() || !option.nonpositional()) return;
        auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const OptionGroup& g) { return g.title == title; });
        if (found == groups.end()) found = groups.insert(found, {title, {}});
        found->options.push_back(argument_of(option));
    };
    const CLI::Option* help[] = {app.get_help_ptr(), app.get_help_all_ptr(), app.get_version_ptr()};
    for (const CLI::Option* option : app.get_options())
        if (std::find(std::begin(help), std::end(help), option) == std::end(help)) add(*option);
    for (const CLI::Option* option : help)
        if (option != nullptr) add(*option);
    return groups;
}

CommandFacts facts_of(const CLI::App& app, const std::string& prefix) {
    CommandFacts facts;
    facts.name = prefix + app.get_name();
    facts.words = app.get_description();
    facts.footer = app.get_footer();
    for (const CLI::Option* option : app.get_options())
        if (option->get_positional()) facts.places.push_back(argument_of(*option));
    facts.groups = groups_of(app);
    for (const CLI::App* command : app.get_subcommands({}))
        facts.commands.push_back(facts_of(*command, facts.name + " "));
    return facts;
}

}  // namespace

std::string CommandFacts::usage() const {
    std::string text = name;
    if (!commands.empty()) text += " COMMAND";
    for (const ArgumentFacts& place : places) text += " " + place.name();
    for (const OptionGroup& group : groups)
        for (const ArgumentFacts& option : group.options)
            if (option.is_required) text += " " + option.name() + " " + option.value;
    return text + " [OPTIONS]";
}

CommandFacts facts_of(const CLI::App& app) { return facts_of(app, ""); }

}  // namespace mirtool
