// SPDX-License-Identifier: MIT
#pragma once

#include "text.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace mirtool {

/// Names a file that was written on standard output. For scripts byte by byte, for people as a
/// terminal may show it.
inline void print_result(const std::string& name) {
    std::printf("%s\n", (isatty(STDOUT_FILENO) != 0 ? shown(name) : name).c_str());
}

}  // namespace mirtool
