// SPDX-License-Identifier: MIT
#include "cuda/gpu_session.hpp"
#include "cuda/kernel_failure.hpp"

int main(int argc, char** argv) {
    if (!mirtest::gpu_tests_can_run(argc, argv)) return mirtest::gpu_tests_skipped;
    if (argc == 2 && std::string_view(argv[1]) == mirtest::fail_in_kernel)
        return mirtest::report_kernel_failure();
    return mirtest::run_gpu_tests(argc, argv);
}
