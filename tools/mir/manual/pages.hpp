// SPDX-License-Identifier: MIT
#pragma once

#include "manual/command_facts.hpp"

#include <string>

namespace mirtool {

// Each describes the whole program in the language of another.

/// The manual page, for man(1).
std::string man_page(const CommandFacts& program);

/// What completes command lines in bash.
std::string bash_completion(const CommandFacts& program);

/// The same in zsh.
std::string zsh_completion(const CommandFacts& program);

/// The same in fish.
std::string fish_completion(const CommandFacts& program);

}  // namespace mirtool
