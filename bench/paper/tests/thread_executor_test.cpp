// SPDX-License-Identifier: MIT
#include "support/thread_executor.hpp"

#include "conformance/executor_suite.hpp"

#include <chrono>

TEST_CASE("ThreadExecutor keeps the axioms of Executor") {
    const unsigned threads = GENERATE(1u, 2u, 5u);
    mirbench::ThreadExecutor executor(threads);
    CHECK(executor.concurrency() == threads);
    mirtest::executor_suite(executor);
}

TEST_CASE("ThreadExecutor runs loops one after the other without losing one") {
    mirbench::ThreadExecutor executor(3);
    std::vector<int> visits(64, 0);
    for (int loop = 0; loop < 2000; ++loop)
        executor.for_each(visits.size(), [&](std::size_t i) { ++visits[i]; });
    bool all = true;
    for (const int v : visits) all = all && v == 2000;
    CHECK(all);
}

TEST_CASE("ThreadExecutor may be shared by threads") {
    mirbench::ThreadExecutor executor(3);
    std::atomic<int> calls{0};
    const auto loops = [&] {
        for (int loop = 0; loop < 5000; ++loop)
            executor.for_each(50, [&](std::size_t) { ++calls; });
    };
    std::thread other(loops);
    loops();
    other.join();
    CHECK(calls == 2 * 5000 * 50);
}

TEST_CASE("ThreadExecutor uses its threads") {
    mirbench::ThreadExecutor executor(2);
    std::atomic<int> inside{0};
    std::atomic<bool> met{false};
    // Each body waits, within reason, for the other.
    executor.for_each(2, [&](std::size_t) {
        ++inside;
        for (int i = 0; i < 2000 && !met; ++i) {
            if (inside == 2) met = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    });
    CHECK(met);
}
