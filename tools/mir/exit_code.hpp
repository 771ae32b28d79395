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

/// What an exit code means, for the manual page.
struct ExitMeaning {
    int code;
    const char* words;
};

inline constexpr ExitMeaning exit_meanings[] = {
    {exit_done, "Done"},
    {exit_failure,
     "Failed while running: a file cannot be written, memory is short; compare: a metric is beyond "
     "its limit"},
    {exit_usage, "Wrong usage: an unknown option, a value out of range"},
    {exit_input,
     "The scene or picture cannot be used: missing, broken, unsupported, without light"},
    {exit_no_device, "The device that --backend names is not there, or no denoiser"},
    {exit_interrupted, "Interrupted; the picture of the finished passes is written"}};

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
