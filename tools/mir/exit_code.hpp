// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

namespace mirtool {

// What the program returns to the shell; listed in docs/command_line.md.
inline constexpr int exit_done = 0;
inline constexpr int exit_failure = 1;
inline constexpr int exit_usage = 2;
inline constexpr int exit_input = 3;
inline constexpr int exit_no_device = 4;
inline constexpr int exit_interrupted = 130;

/// Exit code for a failure of the library.
inline int exit_code_of(mir::ErrorCode code) {
    switch (code) {
        case mir::ErrorCode::invalid_argument:
        case mir::ErrorCode::limit_exceeded:
            return exit_usage;
        case mir::ErrorCode::invalid_input:
        case mir::ErrorCode::unsupported:
            return exit_input;
        case mir::ErrorCode::no_device:
            return exit_no_device;
        case mir::ErrorCode::cancelled:
            return exit_interrupted;
        case mir::ErrorCode::out_of_memory:
        default:
            return exit_failure;
    }
}

}  // namespace mirtool
