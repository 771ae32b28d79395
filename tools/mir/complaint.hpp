// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace mirtool {

/// The command that words were meant for: `app` itself where they named none.
const CLI::App& used_command(const CLI::App& app);

/// What is wrong with the words that `app` was given, and what may have been meant.
std::string complaint(const CLI::App& app, const CLI::ParseError& e);

}  // namespace mirtool
