// SPDX-License-Identifier: MIT
#include "mir/core/discrete_distribution.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <vector>

namespace {

mir::DiscreteDistribution of(const std::vector<float>& weights) {
    return mir::DiscreteDistribution(weights);
}

constexpr float almost_one = 0x1.fffffep-1f;

}  // namespace

TEST_CASE("The first value that something is true of is found, wherever it is") {
    const std::vector<std::uint32_t> values = {2, 3, 3, 3, 7, 8, 8};
    for (std::uint32_t count = 0; count <= values.size(); ++count)
        for (std::uint32_t x = 0; x < 10; ++x) {
            const auto is_above = [=](std::uint32_t v) { return v > x; };
            const auto end = values.begin() + count;
            CHECK(mir::first_that(values.data(), count, is_above) ==
                  std::find_if(values.begin(), end, is_above) - values.begin());
        }
}

TEST_CASE("An index is picked as often as its weight says") {
    const auto d = of({1, 2, 0, 5});
    REQUIRE(d.size() == 4);
    CHECK(d.total() == 8.0);
    CHECK(d.probability(0) == 0.125f);
    CHECK(d.probability(1) == 0.25f);
    CHECK(d.probability(2) == 0.0f);
    CHECK(d.probability(3) == 0.625f);
    // A fine grid of u: exact counts, no chance involved.
    std::vector<int> counts(4);
    for (int i = 0; i < 800; ++i) ++counts[d.sample(static_cast<float>(i) / 800.0f)];
    CHECK(counts == std::vector<int>{100, 200, 0, 500});
}

TEST_CASE("Indices of weight zero are never picked, at either end and between") {
    const auto d = of({0, 0, 3, 0, 1, 0, 0});
    for (float u : {0.0f, 0.25f, 0.5f, 0.75f, almost_one}) {
        const std::uint32_t i = d.sample(u);
        CHECK((i == 2 || i == 4));
    }
    CHECK(d.sample(0.0f) == 2);
    CHECK(d.sample(almost_one) == 4);
}

TEST_CASE("A number next to one stays inside, however the total rounds") {
    std::vector<float> weights(1000, 0.1f);
    weights.push_back(0.0f);
    CHECK(of(weights).sample(almost_one) == 999);
    CHECK(of({1e-38f, 1e38f}).sample(almost_one) == 1);
    CHECK(of({1e30f, 1e-30f}).sample(almost_one) == 0);
}

TEST_CASE("Probabilities of positive weights add up to one") {
    const auto d = of({0.3f, 1e-6f, 7.0f, 0.1f});
    double sum = 0.0;
    for (std::uint32_t i = 0; i < d.size(); ++i) sum += d.probability(i);
    CHECK(sum == mirtest::Approx(1.0).epsilon(1e-6));
}

TEST_CASE("A distribution without weight is empty") {
    CHECK(mir::DiscreteDistribution().empty());
    CHECK(of({}).empty());
    CHECK(of({0, 0}).empty());
    CHECK_FALSE(of({0, 1e-30f}).empty());
}

TEST_CASE("Weights that are negative or not finite are refused") {
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (float bad : {-1.0f, infinity, -infinity, nan}) {
        CAPTURE(bad);
        try {
            of({1.0f, bad});
            FAIL("a bad weight was taken");
        } catch (const mir::Error& e) {
            CHECK(e.code() == mir::ErrorCode::invalid_argument);
        }
    }
}
