// SPDX-License-Identifier: MIT
#include "support/wide_statistics.hpp"

#include "accel/wide_checks.hpp"
#include "support/catch.hpp"

using namespace mirtest;

TEST_CASE("The statistics of a wide tree are what walking it counts") {
    const World world = triangle_soup(9000, 6);
    const mir::WideBvh bvh = build_wide(world.geometry);
    const mir::WideBvhStatistics s = mir::wide_statistics(bvh.nodes());
    const WideCount c = count_wide(bvh);
    CHECK(s.triangles == 9000);
    CHECK(s.nodes == bvh.nodes().size());
    CHECK(s.leaves == c.leaves);
    CHECK(s.depth == c.depth);
    CHECK(s.largest_leaf == c.largest_leaf);
    CHECK(s.expected_nodes == Approx(c.nodes_area).epsilon(1e-5));
    CHECK(s.expected_tests == Approx(c.tests_area).epsilon(1e-5));
    CHECK(s.triangles_per_leaf() == Approx(9000.0 / double(c.leaves)));
    CHECK(s.children_per_node() > 4.0);
}

TEST_CASE("A tree without triangles has one node and costs nothing") {
    const World world{mir::Scene{}};
    const mir::WideBvhStatistics s = mir::wide_statistics(build_wide(world.geometry).nodes());
    CHECK(s.nodes == 1);
    CHECK(s.depth == 1);
    CHECK(s.leaves == 0);
    CHECK(s.sah_cost() == 0.0);
    CHECK(s.triangles_per_leaf() == 0.0);
}
