// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/device.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <iostream>
#include <string_view>

// Tests of the GPU. Without one nothing runs and the program says so with the exit code that CTest
// shows as "Skipped"; its tests can be listed everywhere.

namespace mirtest {

inline constexpr int gpu_tests_skipped = 77;

/// True when there is a GPU, or when tests are only listed. Otherwise prints why they are skipped.
inline bool gpu_tests_can_run(int argc, char** argv) {
    if (std::any_of(argv + 1, argv + argc,
                    [](std::string_view a) { return a.substr(0, 6) == "--list"; }))
        return true;
    try {
        static_cast<void>(mir::cuda::select_device(0));
        return true;
    } catch (const mir::Error& e) {
        std::cout << "skipped: " << e.what() << '\n';
        return false;
    }
}

/// Runs the tests of the program. Never the exit code of skipped ones.
inline int run_gpu_tests(int argc, char** argv) {
    const int failed = Catch::Session().run(argc, argv);
    return failed == gpu_tests_skipped ? 1 : failed;
}

}  // namespace mirtest
