// SPDX-License-Identifier: MIT
#include "mir/cuts/cut_picks.hpp"

#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <set>
#include <vector>

namespace {

constexpr std::uint32_t groups = mir::blocks::groups_per_block;

/// numbers[group][node] of one block.
std::vector<std::vector<std::uint64_t>> numbers_of(std::uint64_t seed, std::uint32_t nodes) {
    mir::CutPicks picks(mir::Random(seed, mir::Stream::cut, 5), nodes);
    std::vector<std::vector<std::uint64_t>> numbers(groups);
    for (std::uint32_t g = 0; g < groups; ++g) {
        picks.start(g);
        for (std::uint32_t i = 0; i < nodes; ++i) numbers[g].push_back(picks(i));
    }
    return numbers;
}

}  // namespace

TEST_CASE(
    "the sixteen numbers of a node lie in sixteenths of their own, those of a pixel far apart") {
    const auto numbers = numbers_of(3, 100);
    for (std::uint32_t i = 0; i < 100; ++i) {
        std::set<std::uint64_t> sixteenths;
        for (std::uint32_t g = 0; g < groups; ++g) sixteenths.insert(numbers[g][i] >> 60);
        CHECK(sixteenths.size() == 16);
        for (const std::uint32_t corner : {0u, 2u, 8u, 10u}) {
            std::set<std::uint64_t> quarters;
            for (const std::uint32_t g : {corner, corner + 1, corner + 4, corner + 5})
                quarters.insert(numbers[g][i] >> 62);
            CHECK(quarters.size() == 4);
        }
    }
}

// Hypothesis: the number of one group and node is uniform over seeds. Level 1 % over the family.
TEST_CASE("each number alone is uniform", "[statistical]") {
    constexpr std::uint32_t nodes = 40;
    constexpr std::size_t cells = 64;
    std::vector<std::vector<double>> counts(groups * 3, std::vector<double>(cells));
    constexpr int seeds = 4000;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const auto numbers = numbers_of(seed, nodes);
        for (std::uint32_t g = 0; g < groups; ++g)
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t node = k == 0 ? 0 : k == 1 ? 33 : 39;
                ++counts[g * 3 + k][numbers[g][node] >> 58];
            }
    }
    const std::vector<double> expected(cells, static_cast<double>(seeds) / cells);
    for (const auto& observed : counts)
        CHECK(mirtest::chi_square(observed, expected).p_value >
              mirtest::sidak(0.01, counts.size()));
}
