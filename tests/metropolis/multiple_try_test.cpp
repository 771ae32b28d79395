// SPDX-License-Identifier: MIT
#include "mir/metropolis/multiple_try.hpp"

#include "support/catch.hpp"

#include <limits>
#include <vector>

using mir::multiple_try;
using mirtest::Approx;

namespace {

mir::MultipleTry step(double current, const std::vector<double>& candidates, double choice,
                      double decision = 0.0) {
    return multiple_try(current, candidates, choice, decision);
}

}  // namespace

TEST_CASE("a candidate is chosen as often as its weight says") {
    const std::vector<double> weights{1, 0, 2, 5};
    std::vector<int> counts(4);
    for (int i = 0; i < 800; ++i) ++counts[step(1, weights, (i + 0.5) / 800).chosen];
    CHECK(counts == std::vector<int>{100, 0, 200, 500});
}

TEST_CASE("losers stand in for the way back") {
    CHECK(step(4, {1, 2, 5}, 0.0).acceptance == Approx(8.0 / 11));  // 8 / (8 - 1 + 4)
    CHECK(step(4, {1, 2, 5}, 0.9).acceptance == Approx(8.0 / 7).margin(1).epsilon(0));
    CHECK(step(4, {1, 2, 5}, 0.9).acceptance == 1.0);
    CHECK(step(9, {1, 2, 5}, 0.9).acceptance == Approx(8.0 / 12));
}

TEST_CASE("a loser far below the winner is not lost to rounding") {
    CHECK(step(3e-20, {1.0, 1e-20}, 0.0).acceptance == 1.0);
    // The sum minus the winner would be 0 here, and the probability 1 / 3e-20 instead of 1 / 1.5.
    CHECK(step(0.5, {1e-20, 1.0}, 0.0).acceptance == Approx(1 / 1.5));
}

TEST_CASE("one candidate is Metropolis' rule") {
    for (double x : {0.3, 1.0, 7.0})
        for (double y : {0.0, 0.1, 1.0, 20.0})
            CHECK(step(x, {y}, 0.5).acceptance == mir::acceptance(x, y));
}

TEST_CASE("the second number decides against the acceptance") {
    CHECK(step(4, {1}, 0.5, 0.0).accepted);
    CHECK(step(4, {1}, 0.5, 0.2499).accepted);
    CHECK_FALSE(step(4, {1}, 0.5, 0.25).accepted);
    CHECK(step(1, {1}, 0.5, 0x1.fffffep-1).accepted);
}

TEST_CASE("without weight, or without candidates, nothing is accepted") {
    for (const auto& none : {std::vector<double>{}, {0.0}, {0.0, 0.0, 0.0}}) {
        const mir::MultipleTry result = step(1, none, 0.0, 0.0);
        CHECK(result.acceptance == 0.0);
        CHECK_FALSE(result.accepted);
    }
}

TEST_CASE("a candidate without weight is never chosen, at either end") {
    for (double choice : {0.0, 0.5, 1 - 0x1p-53}) {
        CHECK(step(1, {0, 0, 3, 0}, choice).chosen == 2);
        CHECK(step(1, {0, 0.1, 0.1, 0.1, 0}, choice).chosen % 4 != 0);
    }
}

TEST_CASE("weights that are no weights are internal errors") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](double current, const std::vector<double>& candidates) {
        try {
            step(current, candidates, 0.5);
        } catch (const mir::Error& e) {
            return e.code() == mir::ErrorCode::internal;
        }
        return false;
    };
    for (double bad : {nan, infinity, -infinity, -1.0}) {
        CAPTURE(bad);
        CHECK(refused(1.0, {1.0, bad}));
        CHECK(refused(bad, {1.0, 1.0}));
    }
    CHECK(refused(0.0, {1.0}));
    CHECK(refused(1.0, {1e308, 1e308}));
}
