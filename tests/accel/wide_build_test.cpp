// SPDX-License-Identifier: MIT
#include "mir/accel/wide_build.hpp"

#include "accel/build_worlds.hpp"
#include "accel/wide_checks.hpp"
#include "mir/accel/wide_traverse.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::Vec3;

TEST_CASE("A wide tree lists every triangle once, in boxes that hold its accept box") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    const Vec3 move = scale * GENERATE(Vec3(0, 0, 0), Vec3(1e4f, -1e4f, 3e3f));
    const World world = triangle_soup(700, 1, scale, move);
    mir::WideBvhOptions options;
    options.leaf_size = GENERATE(1u, 4u, 8u);
    const mir::WideBvh bvh = build_wide(world.geometry, options);
    CHECK(bvh.statistics().largest_leaf <= options.leaf_size);
    check_whole(world.geometry, bvh);
}

TEST_CASE("A wide tree that all threads and single ones made is whole") {
    const World world = triangle_soup(30000, 2, 0.5f);
    const mir::WideBvh bvh = build_wide(world.geometry);
    check_whole(world.geometry, bvh);
    CHECK(bvh.statistics().depth < 12);
    CHECK(bvh.statistics().children_per_node() > 4.0);
}

TEST_CASE("A wide tree over needles is whole") {
    const World world = needles(500, GENERATE(10.0f, 1e4f, 1e7f), 3);
    check_whole(world.geometry, build_wide(world.geometry));
}

TEST_CASE("A wide tree over a flat scene is whole and its leaves lie apart") {
    const World world = flat_grid(32, GENERATE(0, 1, 2));
    const mir::WideBvh bvh = build_wide(world.geometry);
    check_whole(world.geometry, bvh);
    CHECK(bvh.statistics().expected_tests < 16.0);
}

TEST_CASE("Nodes are 256 bytes apart, aligned to 64, and say what their slots hold") {
    const World world = triangle_soup(5, 4);
    const mir::WideBvh bvh = build_wide(world.geometry);
    CHECK(reinterpret_cast<std::uintptr_t>(bvh.nodes().data()) % 64 == 0);
    REQUIRE(bvh.nodes().size() == 1);
    const mir::WideNode& root = bvh.nodes()[0];
    for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
        CHECK(root.is_leaf(slot) == (slot < 5));
        CHECK_FALSE(root.is_inner(slot));
        CHECK(root.count[slot] == (slot < 5 ? 1 : mir::WideNode::empty));
    }
}

TEST_CASE("The wide tree has the same bytes for any number of threads and any order of work") {
    const World world = triangle_soup(40000, 5, 1.0f, {0.25f, 0, 0});
    const mir::WideBvh one = build_wide(world.geometry);
    for (std::size_t threads : {1u, 2u, 3u}) {
        BackwardsExecutor executor{threads};
        const mir::WideBvh other(world.geometry, {}, executor);
        CHECK(equal_bytes(one.nodes(), other.nodes()));
        CHECK(equal_bytes(one.triangles(), other.triangles()));
        CHECK(equal_bytes(one.indices(), other.indices()));
        CHECK(one.statistics().sah_cost() == other.statistics().sah_cost());
    }
}

TEST_CASE("The statistics of a wide tree are what walking it counts") {
    const World world = triangle_soup(9000, 6);
    const mir::WideBvh bvh = build_wide(world.geometry);
    const mir::WideBvhStatistics& s = bvh.statistics();
    const WideCount c = count_wide(bvh);
    CHECK(s.triangles == 9000);
    CHECK(s.nodes == bvh.nodes().size());
    CHECK(s.leaves == c.leaves);
    CHECK(s.depth == c.depth);
    CHECK(s.largest_leaf == c.largest_leaf);
    CHECK(s.expected_nodes == Approx(c.nodes_area).epsilon(1e-5));
    CHECK(s.expected_tests == Approx(c.tests_area).epsilon(1e-5));
    CHECK(s.bytes == bvh.bytes());
    CHECK(s.triangles_per_leaf() == Approx(9000.0 / double(c.leaves)));
    CHECK(s.seconds() > 0.0);
}

TEST_CASE("Cuts by areas cost less than halving by number") {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    for (float x : {-10.0f, 3.0f, 10.0f})
        scene.place(mir::builtin::sphere("s", grey, {x, 0.1f * x, 0}, 1.0f, 24, 12));
    const World world(std::move(scene));
    mir::WideBvhOptions halved;
    halved.max_depth = 1;
    CHECK(build_wide(world.geometry).statistics().sah_cost() <
          0.9 * build_wide(world.geometry, halved).statistics().sah_cost());
}

TEST_CASE("A wide tree never becomes deeper than it may") {
    const World world = nested_triangles(3000, 30);
    mir::WideBvhOptions options;
    options.max_depth = GENERATE(1u, 5u, 6u, 8u, 32u);
    const mir::WideBvh bvh = build_wide(world.geometry, options);
    // 8 * 8 * 8 * 4 triangles fit below three nodes, 8 * 2048 below four.
    const std::uint32_t balanced = 4;
    CHECK(count_wide(bvh).depth <= std::max(options.max_depth, balanced));
    check_whole(world.geometry, bvh);
}

TEST_CASE("The heuristic alone would make the tree of nested triangles deeper") {
    const World world = nested_triangles(3000, 30);
    CHECK(build_wide(world.geometry).statistics().depth > 8);
}

TEST_CASE("A balanced tree has the depth that its number of triangles needs") {
    CHECK(mir::detail::balanced_depth(0, 4) == 0);
    CHECK(mir::detail::balanced_depth(4, 4) == 0);
    CHECK(mir::detail::balanced_depth(5, 4) == 1);
    CHECK(mir::detail::balanced_depth(32, 4) == 1);
    CHECK(mir::detail::balanced_depth(33, 4) == 2);
    CHECK(mir::detail::balanced_depth(0xFFFFFFFFu, 1) <= mir::WideBvhOptions::depth_limit);
    for (std::uint32_t n : {1u, 31u, 33u, 257u, 2047u, 2049u}) {
        const World world = triangle_soup(n, 7);
        mir::WideBvhOptions options;
        options.max_depth = 1;
        CHECK(build_wide(world.geometry, options).statistics().depth ==
              std::max(1u, mir::detail::balanced_depth(n, options.leaf_size)));
    }
}

TEST_CASE("A scene without triangles becomes a root without children") {
    const World world{mir::Scene{}};
    const mir::WideBvh bvh = build_wide(world.geometry);
    REQUIRE(bvh.nodes().size() == 1);
    for (const std::int32_t c : bvh.nodes()[0].count) CHECK(c == mir::WideNode::empty);
    CHECK(bvh.statistics().sah_cost() == 0.0);
    CHECK(bvh.statistics().triangles_per_leaf() == 0.0);
    CHECK_FALSE(mir::is_hidden(bvh.view(), {-1, 0, 0}, {1, 0, 0}));
}

TEST_CASE("One triangle is found in the wide tree made of it") {
    const World world = coincident(1);
    const mir::WideBvh bvh = build_wide(world.geometry);
    check_whole(world.geometry, bvh);
    CHECK(mir::is_hidden(bvh.view(), {0.4f, 0.5f, -1}, {0.4f, 0.5f, 2}));
    CHECK_FALSE(mir::is_hidden(bvh.view(), {-0.4f, 0.5f, -1}, {-0.4f, 0.5f, 2}));
}

TEST_CASE("Thousands of coincident triangles are dealt out evenly") {
    const World world = coincident(20000);
    const mir::WideBvh bvh = build_wide(world.geometry);
    CHECK(bvh.statistics().depth <= 6);
    check_whole(world.geometry, bvh);
    CHECK(mir::is_hidden(bvh.view(), {0.4f, 0.5f, -1}, {0.4f, 0.5f, 2}));
}

TEST_CASE("Huge and tiny scenes make the wide tree of the scene of ordinary size") {
    // Powers of two scale every number of the construction exactly.
    const World one = triangle_soup(2000, 8);
    const World other = triangle_soup(2000, 8, GENERATE(0x1p-20f, 0x1p60f));
    const mir::WideBvh a = build_wide(one.geometry);
    const mir::WideBvh b = build_wide(other.geometry);
    CHECK(equal_bytes(a.indices(), b.indices()));
    CHECK(a.statistics().nodes == b.statistics().nodes);
    CHECK(a.statistics().sah_cost() == Approx(b.statistics().sah_cost()));
}

TEST_CASE("The wide tree refuses coordinates near the end of single precision") {
    const World world = triangle_soup(2, 9, 1e37f);
    CHECK_THROWS_AS(build_wide(world.geometry), mir::Error);
}

TEST_CASE("Options of the wide tree out of range are refused") {
    const World world = triangle_soup(10, 10);
    mir::WideBvhOptions options;
    SECTION("no triangle in a leaf") { options.leaf_size = 0; }
    SECTION("too many triangles in a leaf") { options.leaf_size = 9; }
    SECTION("few bins") { options.bins = 3; }
    SECTION("many bins") { options.bins = 33; }
    SECTION("no depth") { options.max_depth = 0; }
    SECTION("depth") { options.max_depth = 33; }
    CHECK_THROWS_AS(build_wide(world.geometry, options), mir::Error);
}
