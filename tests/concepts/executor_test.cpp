// SPDX-License-Identifier: MIT
#include "mir/concepts/executor.hpp"

#include "conformance/executor_suite.hpp"
#include "mir/concepts/archetypes.hpp"
#include "support/catch.hpp"

namespace {

namespace archetype = mir::archetype;

static_assert(mir::Executor<archetype::Executor>);

struct WithoutForEach : archetype::Executor {
    void for_each();
};
static_assert(!mir::Executor<WithoutForEach>);

struct WithoutConcurrency : archetype::Executor {
    void concurrency();
};
static_assert(!mir::Executor<WithoutConcurrency>);

struct ConcurrencyIsNoNumber : archetype::Executor {
    [[nodiscard]] const char* concurrency() const { return "many"; }
};
static_assert(!mir::Executor<ConcurrencyIsNoNumber>);

static_assert(mir::Executor<mir::InlineExecutor>);

}  // namespace

TEST_CASE("InlineExecutor keeps the axioms of Executor") {
    mir::InlineExecutor executor;
    mirtest::executor_suite(executor);
}

TEST_CASE("InlineExecutor runs in order on the calling thread") {
    mir::InlineExecutor executor;
    std::vector<std::size_t> order;
    executor.for_each(5, [&](std::size_t i) { order.push_back(i); });
    CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
    CHECK(executor.concurrency() == 1);
}

TEST_CASE("The archetype of Executor keeps the axioms too") {
    archetype::Executor executor{archetype::make};
    mirtest::executor_suite(executor);
}
