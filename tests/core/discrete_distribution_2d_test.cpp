// SPDX-License-Identifier: MIT
#include "mir/core/discrete_distribution_2d.hpp"

#include "support/catch.hpp"

#include <vector>

namespace {

constexpr std::uint32_t width = 3;
const std::vector<float> weights{1, 0, 3,  //
                                 0, 0, 0,  //
                                 2, 2, 0};

}  // namespace

// A fine grid of u: exact counts, no chance involved.
TEST_CASE("A cell is picked as often as its weight says, and evenly inside") {
    const mir::DiscreteDistribution2d d(weights, width);
    REQUIRE(d.total() == 8.0);
    constexpr int steps = 80;
    std::vector<int> counts(weights.size());
    std::vector<mir::Vec2> inside(weights.size());
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
            const mir::GridCell c =
                d.view().sample({(float(i) + 0.5f) / steps, (float(j) + 0.5f) / steps});
            const std::size_t cell = c.y * width + c.x;
            ++counts[cell];
            inside[cell] += c.inside;
            REQUIRE((c.inside.x >= 0 && c.inside.x < 1 && c.inside.y >= 0 && c.inside.y < 1));
        }
    for (std::size_t k = 0; k < weights.size(); ++k) {
        CAPTURE(k);
        CHECK(counts[k] == static_cast<int>(weights[k] * steps * steps / 8));
        if (counts[k] == 0) continue;
        const auto n = static_cast<float>(counts[k]);
        CHECK(inside[k].x / n == mirtest::Approx(0.5f).epsilon(1e-4));
        CHECK(inside[k].y / n == mirtest::Approx(0.5f).epsilon(1e-4));
    }
}

TEST_CASE("Places inside an index stay below one, next to its border too") {
    const mir::DiscreteDistribution d(std::vector<float>{0.1f, 0.7f, 0.2f});
    for (std::uint32_t k = 0; k < 4096; ++k) {
        const float u =
            k % 2 == 0 ? static_cast<float>(k) / 4096.0f : 1.0f - static_cast<float>(k) * 0x1p-24f;
        const float place = d.view().place_in(d.sample(u), u);
        REQUIRE((place >= 0.0f && place < 1.0f));
    }
}

TEST_CASE("A grid of no weight is empty, one of half a row is refused") {
    CHECK(mir::DiscreteDistribution2d().empty());
    CHECK(mir::DiscreteDistribution2d(std::vector<float>(6), 3).empty());
    CHECK_THROWS_AS(mir::DiscreteDistribution2d(weights, 2), mir::Error);
    CHECK_THROWS_AS(mir::DiscreteDistribution2d({}, 0), mir::Error);
    CHECK_THROWS_AS(mir::DiscreteDistribution2d(std::vector<float>{1, -1}, 2), mir::Error);
}
