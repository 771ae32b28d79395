// SPDX-License-Identifier: MIT
#include "cuda/kernel_failure.hpp"
#include "mir/cuda/device.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <iostream>
#include <string_view>

// Tests of the GPU. Without one nothing runs and the program says so with the exit code that CTest
// shows as "Skipped"; its tests can be listed everywhere.

namespace {

constexpr int skipped = 77;

bool only_lists(int argc, char** argv) {
    return std::any_of(argv + 1, argv + argc,
                       [](std::string_view a) { return a.substr(0, 6) == "--list"; });
}

bool has_gpu() {
    try {
        static_cast<void>(mir::cuda::select_device(0));
        return true;
    } catch (const mir::Error& e) {
        std::cout << "skipped: " << e.what() << '\n';
        return false;
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (!only_lists(argc, argv) && !has_gpu()) return skipped;
    if (argc == 2 && std::string_view(argv[1]) == mirtest::fail_in_kernel)
        return mirtest::report_kernel_failure();
    const int failed = Catch::Session().run(argc, argv);
    return failed == skipped ? 1 : failed;
}
