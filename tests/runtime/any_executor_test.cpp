// SPDX-License-Identifier: MIT
#include "mir/runtime/any_executor.hpp"

#include "conformance/executor_suite.hpp"
#include "support/catch.hpp"

#include <vector>

namespace {

/// Says that it has three threads, and has one.
struct Three : mir::InlineExecutor {
    [[nodiscard]] std::size_t concurrency() const { return 3; }
};

}  // namespace

TEST_CASE("AnyExecutor keeps the axioms of Executor") {
    mir::InlineExecutor one;
    mir::AnyExecutor executor(one);
    mirtest::executor_suite(executor);
}

TEST_CASE("AnyExecutor runs on the executor that it was given, and its copies do") {
    Three three;
    const mir::AnyExecutor executor(three);
    CHECK(executor.concurrency() == 3);
    mir::AnyExecutor copy = executor;
    std::vector<std::size_t> order;
    const auto body = [&](std::size_t i) { order.push_back(i); };
    copy.for_each(4, body);
    CHECK(order == std::vector<std::size_t>{0, 1, 2, 3});
}
