// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/validation/report.hpp"

#include <atomic>
#include <exception>
#include <vector>

namespace mir::validation {

namespace detail {

/// What a body of a check throws.
struct BodyFailed : std::exception {};

/// Each index once, none missing when for_each() returns.
template <Executor E>
void expect_every_index(E& executor, Report& report) {
    for (const std::size_t n : {0u, 1u, 2u, 17u, 10000u}) {
        std::vector<std::atomic<int>> visits(n);
        std::atomic<std::size_t> outside{0};
        executor.for_each(n, [&](std::size_t i) {
            if (i < n)
                ++visits[i];
            else
                ++outside;
        });
        std::size_t bad = outside;
        for (const auto& v : visits) bad += v == 1 ? 0 : 1;
        report.expect(bad == 0, "every index is visited once before for_each returns",
                      std::to_string(bad) + " of " + std::to_string(n) + " were not");
    }
}

/// What bodies wrote, without an atomic, is there for the caller.
template <Executor E>
void expect_writes_are_seen(E& executor, Report& report) {
    std::vector<std::size_t> squares(1000);
    executor.for_each(squares.size(), [&](std::size_t i) { squares[i] = i * i; });
    std::size_t bad = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) bad += squares[i] == i * i ? 0 : 1;
    report.expect(bad == 0, "what bodies wrote is seen by the caller",
                  std::to_string(bad) + " of 1000 values are not there");
}

/// An exception of a body reaches the caller, and the executor lives on.
template <Executor E>
void expect_exceptions_pass(E& executor, Report& report) {
    bool reached = false;
    try {
        executor.for_each(1000, [](std::size_t i) {
            if (i == 321) throw BodyFailed();
        });
    } catch (const BodyFailed&) {
        reached = true;
    }
    report.expect(reached, "an exception of a body reaches the caller", "for_each returned");
    std::atomic<int> calls{0};
    executor.for_each(10, [&](std::size_t) { ++calls; });
    report.expect(calls == 10, "loops work after one that failed",
                  std::to_string(calls) + " of 10 bodies ran");
}

}  // namespace detail

/// The axioms of Executor, and what mir's own loops rely on: they may be nested. An executor whose
/// threads wait for one another in nested loops hangs here; run it with a time limit. An exception
/// that is thrown on a thread of the executor and not caught there ends the program.
template <Executor E>
Report check_executor(E& executor) {
    Report report;
    detail::expect_every_index(executor, report);
    detail::expect_writes_are_seen(executor, report);
    detail::expect_exceptions_pass(executor, report);
    std::atomic<int> calls{0};
    executor.for_each(8, [&](std::size_t) { executor.for_each(8, [&](std::size_t) { ++calls; }); });
    report.expect(calls == 64, "loops may be nested", std::to_string(calls) + " of 64 bodies ran");
    report.expect(static_cast<std::size_t>(executor.concurrency()) >= 1,
                  "at least one body runs at a time", "concurrency() is 0");
    return report;
}

}  // namespace mir::validation
