// SPDX-License-Identifier: MIT
#pragma once

#include "row.hpp"

#include <string>

namespace mirpaper {

/// Everything that was measured, in all digits.
std::string json_of(const Results& results);

/// A line per row, with the same columns for all figures; empty where a figure has nothing to say.
std::string csv_of(const Results& results);

/// Tables laid out as the paper's figures are, its numbers next to ours.
std::string markdown_of(const Results& results);

/// Writes paper.json, paper.csv and paper.md into `folder`, which is made when it is not there.
/// @throws Error(io) when that fails.
void write_reports(const Results& results, const std::string& folder);

}  // namespace mirpaper
