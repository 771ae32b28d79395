// SPDX-License-Identifier: MIT
#pragma once

#include "manual/command_facts.hpp"
#include "options.hpp"

namespace mirtool {

/// Result of parsing the command line: a command or an exit code. The code means that everything
/// has been said already (help, version, wrong usage).
using Parsed = std::variant<Command, int>;

/// Parses the arguments. Help and version go to stdout, complaints to stderr.
Parsed parse(int argc, char** argv);

/// All commands, arguments and options, as parse() knows them.
CommandFacts program_facts();

}  // namespace mirtool
