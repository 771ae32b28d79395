// SPDX-License-Identifier: MIT
#include "mir/paths/each_path.hpp"

#include "mir/host/tbb_executor.hpp"
#include "support/catch.hpp"

#include <numeric>

namespace {

/// Paths that weigh what their first number is.
struct FirstNumber {
    void generate(mir::NearbyNumbers u, mir::WeightedPath& out) const {
        out.weight = static_cast<double>(u.at(0));
    }
};

}  // namespace

TEST_CASE("each path of a range is built once, from numbers that bear its index") {
    mir::TbbExecutor threads(4);
    std::vector<int> calls(1500);
    std::vector<double> weights(1500);
    mir::each_path(FirstNumber{}, {9, mir::Stream::test, 300, 1500}, threads,
                   [&](std::uint64_t i, const mir::WeightedPath& p) {
                       ++calls[i];
                       weights[i] = p.weight;
                   });
    CHECK(std::accumulate(calls.begin(), calls.end(), 0) == 1200);
    for (std::uint64_t i : {300u, 555u, 556u, 1499u}) {
        CHECK(calls[i] == 1);
        CHECK(weights[i] == static_cast<double>(mir::Random(9, mir::Stream::test, i).at(0)));
    }
    CHECK(calls[299] == 0);
}
