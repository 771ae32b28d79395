// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>

namespace mirtool {

/// The front of an explanation, for lists where a line is short.
inline std::string brief(const std::string& words) {
    std::size_t end = words.size();
    for (const char* mark : {": ", "; ", " ("}) end = std::min(end, words.find(mark));
    return words.substr(0, end);
}

}  // namespace mirtool
