// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace mirtool {

/// An option, or an argument that is known by its place, as people meet it.
struct ArgumentFacts {
    std::vector<std::string> names;    ///< "-o", "--output"; of a place one, without hyphens
    std::string value;                 ///< what stands behind it: "FILE", "N"; empty: nothing
    std::vector<std::string> choices;  ///< words that it takes, where these are known
    bool is_list = false;              ///< takes several of them, separated by commas
    bool is_required = false;
    std::string words;      ///< what it is and its default
    std::string condition;  ///< "1 to 64; with --sun"; empty: none

    /// The name to find it by: the long one.
    [[nodiscard]] const std::string& name() const { return names.back(); }
    [[nodiscard]] bool takes_file() const { return value == "FILE"; }
};

/// Options under one title.
struct OptionGroup {
    std::string title;
    std::vector<ArgumentFacts> options;
};

/// What the command line knows of a command.
struct CommandFacts {
    std::string name;  ///< "mir render"
    std::string words;
    std::string footer;  ///< examples; empty: none
    std::vector<ArgumentFacts> places;
    std::vector<OptionGroup> groups;  ///< options for help come last
    std::vector<CommandFacts> commands;

    /// The last word of the name.
    [[nodiscard]] std::string own_name() const { return name.substr(name.rfind(' ') + 1); }
    /// "mir render scene [OPTIONS]".
    [[nodiscard]] std::string usage() const;
};

/// Reads the facts off what parses the command line. Hidden options are left out.
CommandFacts facts_of(const CLI::App& app);

}  // namespace mirtool
