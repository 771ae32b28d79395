// SPDX-License-Identifier: MIT
#include "cuda/gpu_session.hpp"

int main(int argc, char** argv) {
    if (!mirtest::gpu_tests_can_run(argc, argv)) return mirtest::gpu_tests_skipped;
    return mirtest::run_gpu_tests(argc, argv);
}
