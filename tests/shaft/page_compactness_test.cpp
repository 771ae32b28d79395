// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/page_compactness.hpp"

#include "support/catch.hpp"

#include <limits>
#include <vector>

namespace {

bool are_compact(const std::vector<float>& diagonals, float diagonal) {
    mir::RunSizes sizes;
    for (const float d : diagonals) sizes.add(d);
    return sizes.are_compact(diagonal);
}

}  // namespace

TEST_CASE("Runs that fill a square, seen straight or obliquely, are compact") {
    CHECK(are_compact(std::vector<float>(64, 1.0f), 8.0f));
    std::vector<float> oblique;
    for (int i = 0; i < 64; ++i) oblique.push_back(1.0f + static_cast<float>(i) / 64.0f);
    CHECK(are_compact(oblique, 14.0f));
}

TEST_CASE("Runs are not compact where few of them, or all, reach far") {
    std::vector<float> edge(64, 1.0f);
    for (std::size_t i = 0; i < edge.size(); i += 8) edge[i] = 40.0f;
    CHECK_FALSE(are_compact(edge, 42.0f));
    CHECK_FALSE(are_compact(std::vector<float>(64, 40.0f), 42.0f));
}

TEST_CASE("Runs without extent, or of what is no number, are left alone") {
    CHECK(are_compact({}, 0.0f));
    CHECK(are_compact({0.0f, 0.0f}, 0.0f));
    CHECK(are_compact({1.0f, 1.0f, 0.0f, 0.0f}, 1.4f));
    const float none = std::numeric_limits<float>::quiet_NaN();
    CHECK(are_compact({1.0f, 1.0f, none}, 1.4f));
    CHECK(are_compact({1.0f, 1.0f}, none));
}
