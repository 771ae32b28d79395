// SPDX-License-Identifier: MIT
#include "mir/validation/executor.hpp"

#include "support/catch.hpp"
#include "validation/finds.hpp"

namespace {

using mirtest::finds;
using mirtest::finds_only;

// Each differs from InlineExecutor in what its name says.

struct DropsTheLast : mir::InlineExecutor {
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        for (std::size_t i = 0; i + 1 < n; ++i) body(i);
    }
};
struct RunsTheFirstTwice : mir::InlineExecutor {
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        if (n > 1000) body(0);
        InlineExecutor::for_each(n, body);
    }
};
struct RunsOneTooMany : mir::InlineExecutor {
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        InlineExecutor::for_each(n == 0 ? 1 : n, body);
    }
};
struct SwallowsExceptions : mir::InlineExecutor {
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        try {
            InlineExecutor::for_each(n, body);
        } catch (...) {
            return;
        }
    }
};
struct StopsAfterAnException : mir::InlineExecutor {
    bool failed = false;

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        if (failed) return;
        failed = true;
        InlineExecutor::for_each(n, body);
        failed = false;
    }
};
struct RefusesInnerLoops : mir::InlineExecutor {
    bool busy = false;

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        if (busy) return;
        busy = true;
        try {
            InlineExecutor::for_each(n, body);
        } catch (...) {
            busy = false;
            throw;
        }
        busy = false;
    }
};
struct HasNoThread : mir::InlineExecutor {
    [[nodiscard]] std::size_t concurrency() const { return 0; }
};
/// Bodies get a copy of what they write to.
struct WritesElsewhere : mir::InlineExecutor {
    int loops = 0;

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        if (n == 1000 && ++loops == 1) return;
        InlineExecutor::for_each(n, body);
    }
};

template <class E>
mir::validation::Report check() {
    E executor;
    return mir::validation::check_executor(executor);
}

}  // namespace

TEST_CASE("check_executor finds nothing wrong with a right one") {
    CHECK(check<mir::InlineExecutor>().passed());
}

TEST_CASE("check_executor finds each axiom that an executor breaks") {
    const char* once = "every index is visited once before for_each returns";
    CHECK(finds(check<DropsTheLast>(), once));
    CHECK(finds_only(check<RunsTheFirstTwice>(), once));
    CHECK(finds(check<RunsOneTooMany>(), once));
    CHECK(finds_only(check<SwallowsExceptions>(), "an exception of a body reaches the caller"));
    CHECK(finds(check<StopsAfterAnException>(), "loops work after one that failed"));
    CHECK(finds_only(check<RefusesInnerLoops>(), "loops may be nested"));
    CHECK(finds_only(check<HasNoThread>(), "at least one body runs at a time"));
    CHECK(finds_only(check<WritesElsewhere>(), "what bodies wrote is seen by the caller"));
}
