// SPDX-License-Identifier: MIT
#pragma once

#include "tool/mir_program.hpp"

#include <map>
#include <string>
#include <vector>

namespace mirtest {

/// The commands that have options of their own.
inline const Words tool_commands{"render",  "info",    "export", "compare",
                                 "denoise", "devices", "manual"};

/// Long options by the titles under which a help shows them.
inline std::map<std::string, Words> groups_of(const std::string& help) {
    std::map<std::string, Words> groups;
    std::string title;
    for (const std::string& line : lines_of(help)) {
        if (line.ends_with(':') && !line.starts_with(' ')) title = line;
        const std::size_t name = line.find("--");
        if (!line.starts_with("  -") || name == std::string::npos) continue;
        groups[title].push_back(line.substr(name, line.find_first_of(" ,", name) - name));
    }
    return groups;
}

/// Every long option of a command.
inline Words options_of(const std::string& command) {
    Words options;
    for (const auto& [title, group] : groups_of(run_mir({command, "--help-all"}).out))
        options = options + group;
    return options;
}

}  // namespace mirtest
