// SPDX-License-Identifier: MIT
#include "mir/reference/path_rules.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"
#include "wrong_models.hpp"

#include <limits>

using mir::BalanceRules;
using mir::PowerRules;
using mirtest::Approx;

namespace {

template <class Rules>
bool weights_add_up() {
    for (float a : {1e-6f, 0.3f, 1.0f, 70.0f, 1e20f})
        for (float b : {1e-6f, 0.3f, 1.0f, 70.0f, 1e20f})
            if (std::abs(Rules::mis(a, b) + Rules::mis(b, a) - 1.0f) > 1e-6f) return false;
    return true;
}

/// Mean throughput of a channel after roulette with evenly spread numbers.
template <class Rules>
double mean_after_roulette(mir::Rgb throughput) {
    double sum = 0.0;
    constexpr int count = 1 << 16;
    for (int i = 0; i < count; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / count;
        sum += static_cast<double>(Rules::roulette(throughput, u).g);
    }
    return sum / count;
}

}  // namespace

TEST_CASE("the weights of two techniques add up to one") {
    CHECK(weights_add_up<BalanceRules>());
    CHECK(weights_add_up<PowerRules>());
    CHECK_FALSE(weights_add_up<mirtest::DoubleCounting>());
    CHECK_FALSE(weights_add_up<mirtest::UnevenWeights>());
}

TEST_CASE("a technique without a rival has weight one, one that is never used counts nothing") {
    const float infinite = std::numeric_limits<float>::infinity();
    CHECK(BalanceRules::mis(0.2f, 0.0f) == 1.0f);
    CHECK(PowerRules::mis(0.2f, 0.0f) == 1.0f);
    CHECK(BalanceRules::mis(0.2f, infinite) == 0.0f);
    CHECK(PowerRules::mis(0.2f, infinite) == 0.0f);
}

TEST_CASE("the power heuristic favours the denser technique") {
    CHECK(PowerRules::mis(3.0f, 1.0f) == Approx(0.9f));
    CHECK(BalanceRules::mis(3.0f, 1.0f) == Approx(0.75f));
}

TEST_CASE("a density per area becomes one per steradian by d^2 / cos") {
    CHECK(BalanceRules::per_steradian(0.5f, 9.0f, 0.25f) == Approx(18.0f));
}

TEST_CASE("roulette keeps the mean of every channel") {
    for (const mir::Rgb t : {mir::Rgb{0.2f, 0.1f, 0.0f}, {0.9f, 0.3f, 0.5f}, {3.0f, 2.0f, 1.0f}}) {
        CHECK(mean_after_roulette<BalanceRules>(t) ==
              Approx(static_cast<double>(t.g)).epsilon(1e-3));
    }
    CHECK(mean_after_roulette<mirtest::NoCompensation>({0.2f, 0.1f, 0.0f}) < 0.05);
}

TEST_CASE("roulette ends black paths, and every other with odds that do not vanish") {
    CHECK(is_black(BalanceRules::roulette({}, 0.0f)));
    for (const mir::Rgb t : {mir::Rgb{1.0f, 0.5f, 0.0f}, {40.0f, 1.0f, 1.0f}}) {
        CHECK(BalanceRules::roulette(t, 0.9989f) == t * (1.0f / BalanceRules::most_odds));
        CHECK(is_black(BalanceRules::roulette(t, 0.9991f)));
    }
}
