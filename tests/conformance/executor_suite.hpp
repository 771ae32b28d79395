// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <stdexcept>
#include <vector>

// The axioms of Executor.

namespace mirtest {

template <mir::Executor E>
void executor_suite(E& executor) {
    SECTION("each index is visited once") {
        for (std::size_t n : {1u, 2u, 17u, 10000u}) {
            std::vector<std::atomic<int>> visits(n);
            executor.for_each(n, [&](std::size_t i) { ++visits.at(i); });
            bool once = true;
            for (const auto& v : visits) once = once && v == 1;
            CHECK(once);
        }
    }
    SECTION("an empty loop calls nothing") {
        std::atomic<int> calls{0};
        executor.for_each(0, [&](std::size_t) { ++calls; });
        CHECK(calls == 0);
    }
    SECTION("everything is done when for_each returns") {
        std::vector<std::size_t> squares(1000);
        executor.for_each(squares.size(), [&](std::size_t i) { squares[i] = i * i; });
        bool done = true;
        for (std::size_t i = 0; i < squares.size(); ++i) done = done && squares[i] == i * i;
        CHECK(done);
    }
    SECTION("an exception of a body reaches the caller, and the executor lives on") {
        const auto fail = [](std::size_t i) {
            if (i == 321) throw std::domain_error("321");
        };
        CHECK_THROWS_AS(executor.for_each(1000, fail), std::domain_error);
        std::atomic<int> calls{0};
        executor.for_each(10, [&](std::size_t) { ++calls; });
        CHECK(calls == 10);
    }
    SECTION("loops may be nested") {
        std::atomic<int> calls{0};
        executor.for_each(
            8, [&](std::size_t) { executor.for_each(8, [&](std::size_t) { ++calls; }); });
        CHECK(calls == 64);
    }
    SECTION("at least one body runs at a time") { CHECK(executor.concurrency() >= 1); }
}

}  // namespace mirtest
