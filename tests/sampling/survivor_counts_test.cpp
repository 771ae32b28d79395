// SPDX-License-Identifier: MIT
#include "mir/sampling/survivor_counts.hpp"

#include "support/catch.hpp"

namespace {

using mir::SurvivorCounts;
using mirtest::Approx;

}  // namespace

TEST_CASE("without the lamp level n holds floor(rho^(n-1) N)") {
    const SurvivorCounts c(100, 0.5, 32, false);
    const std::uint64_t expected[] = {100, 100, 50, 25, 12, 6, 3, 1};
    for (std::size_t n = 0; n < 8; ++n) CHECK(c.at(n) == expected[n]);
    CHECK(c.at(8) == 0);
    CHECK(c.at(1000) == 0);
    CHECK(c.vpls(false) == 100 + 50 + 25 + 12 + 6 + 3 + 1);
}

TEST_CASE("with the lamp level n holds floor(rho^n N), the lamp being level 0") {
    const SurvivorCounts c(100, 0.5, 32, true);
    const std::uint64_t expected[] = {100, 50, 25, 12, 6, 3, 1, 0};
    for (std::size_t n = 0; n < 8; ++n) CHECK(c.at(n) == expected[n]);
    CHECK(c.vpls(true) == 100 + 50 + 25 + 12 + 6 + 3 + 1);
    CHECK(c.vpls(true) < 200);  // N / (1 - rho)
}

TEST_CASE("survival is the actual ratio of the counts, so that flooring loses no energy") {
    const SurvivorCounts c(100, 0.37, 32, false);
    CHECK(c.survival(1) == 1.0f);
    double product = 1.0;
    for (std::size_t n = 1; c.at(n) > 0; ++n) {
        product *= static_cast<double>(c.survival(n));
        CHECK(product * 100 == Approx(static_cast<double>(c.at(n))).epsilon(1e-5));
    }
}

TEST_CASE("levels end at the largest one asked for") {
    const SurvivorCounts c(1000, 1.0, 4, false);
    CHECK(c.at(4) == 1000);
    CHECK(c.at(5) == 0);
    CHECK(c.vpls(false) == 4000);
}

TEST_CASE("black surfaces leave one level, and none with the lamp") {
    const SurvivorCounts without(10, 0.0, 32, false);
    CHECK(without.at(1) == 10);
    CHECK(without.at(2) == 0);
    const SurvivorCounts with(10, 0.0, 32, true);
    CHECK(with.at(1) == 0);
    CHECK(with.vpls(true) == 10);
}

TEST_CASE("for_total finds the largest set that fits") {
    for (bool from_lamp : {false, true})
        for (double rho : {0.0, 0.25, 0.5, 0.9, 1.0})
            for (std::uint64_t vpls : {1ull, 2ull, 7ull, 256ull, 1000ull, 100'000ull})
                for (std::uint8_t levels : {std::uint8_t{1}, std::uint8_t{5}, std::uint8_t{40}}) {
                    CAPTURE(from_lamp, rho, vpls, int{levels});
                    const auto c = SurvivorCounts::for_total(vpls, rho, levels, from_lamp);
                    const SurvivorCounts next(c.at(0) + 1, rho, levels, from_lamp);
                    CHECK(c.at(0) >= 1);
                    CHECK((c.vpls(from_lamp) <= vpls || c.at(0) == 1));
                    CHECK(next.vpls(from_lamp) > vpls);
                }
}

TEST_CASE("nothing wanted still starts one particle") {
    CHECK(SurvivorCounts::for_total(0, 0.5, 8, false).at(0) == 1);
}

TEST_CASE("an empty object has no level") {
    CHECK(SurvivorCounts{}.at(0) == 0);
    CHECK(SurvivorCounts{}.vpls(true) == 0);
}
