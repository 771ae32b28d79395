// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_build.hpp"

#include "accel/build_worlds.hpp"
#include "accel/kd_cells.hpp"
#include "mir/accel/kd/kd_traverse.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::Vec3;

namespace {

mir::KdTree build(const mir::WorldGeometry& geometry, const mir::KdTreeOptions& options = {}) {
    mir::InlineExecutor executor;
    return {geometry, options, executor};
}

/// Cuts as deep as it can, so that lists are checked in many small cells.
mir::KdTree build_deep(const mir::WorldGeometry& geometry) {
    mir::KdTreeOptions options;
    options.traversal_cost = 0.02f;
    return build(geometry, options);
}

double volume_of(const mir::KdTree& tree) {
    return LeafCell{{}, tree.view().low, tree.view().high, 0}.volume();
}

void check_lists_and_cells(const mir::WorldGeometry& geometry, const mir::KdTree& tree) {
    const ListErrors errors = list_errors(geometry, tree);
    CHECK(errors.missing == 0);
    CHECK(errors.superfluous == 0);
    double volume = 0.0;
    for (const LeafCell& cell : leaf_cells(tree)) {
        CHECK(cell.volume() > 0.0);
        volume += cell.volume();
    }
    CHECK(volume == Approx(volume_of(tree)).epsilon(1e-9));
}

}  // namespace

TEST_CASE("A leaf of the kd-tree lists every triangle that may be accepted in its cell") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    const Vec3 move = scale * GENERATE(Vec3(0, 0, 0), Vec3(1e4f, -1e4f, 3e3f));
    const World world = triangle_soup(200, 1, scale, move);
    const mir::KdTree tree = build_deep(world.geometry);
    CHECK(tree.statistics().depth > 12);
    check_lists_and_cells(world.geometry, tree);
}

TEST_CASE("A leaf of the kd-tree lists the needles that may be accepted in its cell") {
    const float aspect = GENERATE(10.0f, 1e3f, 1e5f, 1e7f);
    const World world = needles(100, aspect, 2);
    check_lists_and_cells(world.geometry, build_deep(world.geometry));
}

TEST_CASE("Closed bodies with shared and axis-aligned faces are listed in full") {
    const World world = sphere_in_box();
    check_lists_and_cells(world.geometry, build_deep(world.geometry));
}

TEST_CASE("Nodes that all threads cut, and one thread by bins, lose no triangle") {
    const World world = triangle_soup(9000, 3, 0.5f);
    const mir::KdTree tree = build(world.geometry);
    CHECK(tree.statistics().depth > 10);
    check_lists_and_cells(world.geometry, tree);
}

TEST_CASE("The kd-tree answers as asking every triangle does") {
    const float aspect = GENERATE(0.0f, 1e2f, 1e4f);
    const World world = aspect > 0.0f ? needles(2000, aspect, 4) : triangle_soup(500, 5);
    const mir::KdTree tree = build(world.geometry);
    mir::Random random = test_random(6);
    std::uint64_t different = 0;
    std::uint64_t hidden = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 a = 1.5f * point_in_cube(random);
        const Vec3 b = 1.5f * point_in_cube(random);
        bool any = false;
        for (const mir::TriangleRows& rows : tree.triangles())
            any = any || mir::hits_segment(rows, a, b);
        hidden += any ? 1 : 0;
        different += any != mir::is_hidden(tree.view(), a, b) ? 1 : 0;
    }
    CHECK(different == 0);
    CHECK(hidden > (aspect > 1e3f ? 10 : 100));
}

TEST_CASE("The kd-tree has the same bytes for any number of threads and any order of work") {
    const World world = triangle_soup(40000, 7, 1.0f, {0.25f, 0, 0});
    const mir::KdTree one = build(world.geometry);
    for (std::size_t threads : {1u, 2u, 3u}) {
        BackwardsExecutor executor{threads};
        const mir::KdTree other(world.geometry, {}, executor);
        CHECK(equal_bytes(one.nodes(), other.nodes()));
        CHECK(equal_bytes(one.references(), other.references()));
        CHECK(equal_bytes(one.triangles(), other.triangles()));
        CHECK(one.statistics().sah_cost == other.statistics().sah_cost);
    }
}

TEST_CASE("The statistics of a kd-tree are what walking it counts") {
    const World world = triangle_soup(9000, 8);
    mir::KdTreeOptions options;
    options.traversal_cost = 0.4f;
    const mir::KdTree tree = build(world.geometry, options);
    const mir::KdTreeStatistics& s = tree.statistics();
    const TreeCount count = count_tree(tree, double(options.visit_cost()));
    CHECK(s.triangles == 9000);
    CHECK(s.nodes == tree.nodes().size() - 1);
    CHECK(s.nodes == count.inner + count.leaves);
    CHECK(s.leaves == count.leaves);
    CHECK(s.empty_leaves == count.empty);
    CHECK(count.empty > 100);
    CHECK(s.references == count.references);
    CHECK(s.references == tree.references().size());
    CHECK(s.depth == count.depth);
    CHECK(s.largest_leaf == count.largest);
    CHECK(s.sah_cost == Approx(count.cost).epsilon(1e-5));
    CHECK(s.bytes == tree.bytes());
    CHECK(s.references_per_triangle() == Approx(double(count.references) / 9000.0));
}

TEST_CASE("Children lie side by side where one fetch of 16 bytes reaches both") {
    const World world = triangle_soup(9000, 9);
    const mir::KdTree tree = build(world.geometry);
    CHECK(reinterpret_cast<std::uintptr_t>(tree.nodes().data()) % alignof(mir::KdChildren) == 0);
    for (const mir::KdNode node : tree.nodes())
        if (!node.is_leaf()) CHECK(node.below() % 2 == 0);
}

TEST_CASE("A scene without triangles becomes one empty leaf") {
    const World world{mir::Scene{}};
    const mir::KdTree tree = build(world.geometry);
    REQUIRE(tree.nodes().size() == 2);
    CHECK(tree.nodes()[1].is_leaf());
    CHECK(tree.nodes()[1].count() == 0);
    CHECK(tree.statistics().triangles_per_leaf() == 0.0);
    CHECK(tree.statistics().sah_cost == 0.0);
    CHECK_FALSE(mir::is_hidden(tree.view(), {-1, 0, 0}, {1, 0, 0}));
}

TEST_CASE("One triangle is found in the tree made of it") {
    const World world = coincident(1);
    const mir::KdTree tree = build(world.geometry);
    check_lists_and_cells(world.geometry, tree);
    CHECK(mir::is_hidden(tree.view(), {0.4f, 0.5f, -1}, {0.4f, 0.5f, 2}));
    CHECK_FALSE(mir::is_hidden(tree.view(), {-0.4f, 0.5f, -1}, {-0.4f, 0.5f, 2}));
}

TEST_CASE("Thousands of coincident triangles share leaves") {
    const World world = coincident(20000);
    const mir::KdTree tree = build(world.geometry);
    CHECK(tree.statistics().references < 200 * 20000ull);
    CHECK(tree.statistics().depth <= mir::KdTreeView<mir::Space::host>::max_depth);
    check_lists_and_cells(world.geometry, tree);
    CHECK(mir::is_hidden(tree.view(), {0.4f, 0.5f, -1}, {0.4f, 0.5f, 2}));
}

TEST_CASE("A scene that is flat in an axis is cut in the two others") {
    const int normal = GENERATE(0, 1, 2);
    const World world = flat_grid(24, normal);
    const mir::KdTree tree = build_deep(world.geometry);
    check_lists_and_cells(world.geometry, tree);
    CHECK(tree.statistics().largest_leaf <= 8);
}

TEST_CASE("Huge and tiny scenes make the tree of the scene of ordinary size") {
    // Powers of two scale every number of the construction exactly.
    const World one = triangle_soup(2000, 9);
    const float scale = GENERATE(0x1p-30f, 0x1p60f);
    const World other = triangle_soup(2000, 9, scale);
    const mir::KdTree a = build(one.geometry);
    const mir::KdTree b = build(other.geometry);
    CHECK(equal_bytes(a.references(), b.references()));
    CHECK(a.statistics().nodes == b.statistics().nodes);
    CHECK(a.statistics().sah_cost == Approx(b.statistics().sah_cost));
}

TEST_CASE("Coordinates near the end of single precision are refused with a reason") {
    const World world = triangle_soup(2, 10, 1e37f);
    CHECK_THROWS_AS(build(world.geometry), mir::Error);
}

TEST_CASE("A tree never becomes deeper than it may") {
    const World world = nested_triangles(100, 6);
    mir::KdTreeOptions options;
    options.traversal_cost = 0.01f;
    options.max_depth = GENERATE(1u, 5u, 64u);
    const mir::KdTree tree = build(world.geometry, options);
    CHECK(tree.statistics().depth <= options.max_depth);
    CHECK(list_errors(world.geometry, tree).missing == 0);
}

TEST_CASE("Options out of range and too many references are refused") {
    const World world = triangle_soup(500, 11);
    mir::KdTreeOptions options;
    SECTION("cost") { options.traversal_cost = 0.0f; }
    SECTION("not a number") { options.intersection_cost = std::nanf(""); }
    SECTION("bonus") { options.empty_bonus = 1.0f; }
    SECTION("depth") { options.max_depth = 65; }
    SECTION("references") { options.max_references = 400; }
    CHECK_THROWS_AS(build(world.geometry, options), mir::Error);
}

TEST_CASE("A triangle whose ends coincide with others is cut off from empty space") {
    // Two bodies far from each other: planes touch both, and the gap is one empty leaf or more.
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    for (float x : {-10.0f, 10.0f})
        scene.place(mir::builtin::sphere("s", grey, {x, 0, 0}, 1.0f, 24, 12));
    const World world(std::move(scene));
    const mir::KdTree tree = build(world.geometry);
    double empty = 0.0;
    for (const LeafCell& cell : leaf_cells(tree))
        if (cell.leaf.count() == 0) empty += cell.volume();
    CHECK(empty / volume_of(tree) > 0.85);
}
