// SPDX-License-Identifier: MIT
#include "mir/host/tbb_executor.hpp"

#include "conformance/executor_suite.hpp"
#include "support/catch.hpp"

TEST_CASE("TbbExecutor keeps the axioms of Executor") {
    const unsigned threads = GENERATE(0u, 1u, 3u);
    mir::TbbExecutor executor(threads);
    mirtest::executor_suite(executor);
}

TEST_CASE("TbbExecutor keeps to the number of threads that was asked for") {
    CHECK(mir::TbbExecutor(1).concurrency() == 1);
    CHECK(mir::TbbExecutor(3).concurrency() == 3);
}
