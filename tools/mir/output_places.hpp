// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace mirtool {

/// True when both names lead to one file, or would. As the file system counts what is there, else
/// by folder and name. An empty name leads nowhere.
bool are_one_file(const std::string& a, const std::string& b);

/// Checks, before any work is done, that the files `outputs` can be written. They are those of a
/// job (such as "render"); none of them may replace another or one of `inputs`. Empty names are
/// left out.
/// @throws mir::Error(io or invalid_argument).
void check_output_places(const std::vector<std::string>& inputs,
                         const std::vector<std::string>& outputs, const std::string& job);

}  // namespace mirtool
