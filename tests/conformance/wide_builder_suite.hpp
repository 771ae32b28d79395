// SPDX-License-Identifier: MIT
#pragma once

#include "accel/against_brute_force.hpp"
#include "accel/wide_checks.hpp"
#include "mir/accel/wide/wide_traverse.hpp"
#include "mir/scenes.hpp"
#include "support/copied_wide_bvh.hpp"

// What a tree promises that a backend builds. `build(geometry, options)` gives a CopiedWideBvh.

namespace mirtest {

/// The order that shafts like: children of a node by surface, the largest first, and the triangles
/// in its own leaves side by side. Boxes were rounded before their surfaces were compared.
inline void check_order(std::span<const mir::WideNode> nodes) {
    std::size_t wrong = 0;
    for (const mir::WideNode& node : nodes) {
        double before = std::numeric_limits<double>::infinity();
        std::uint32_t next = 0;
        bool first = true;
        for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
            if (node.count[slot] == mir::WideNode::empty) continue;
            const double area = half_area(child_of(node, slot).box);
            wrong += area <= before * (1.0 + 1e-5) ? 0 : 1;
            before = area;
            if (!node.is_leaf(slot)) continue;
            wrong += first || node.ref[slot] == next ? 0 : 1;
            next = node.ref[slot] + static_cast<std::uint32_t>(node.count[slot]);
            first = false;
        }
    }
    CHECK(wrong == 0);
}

/// Everything that can be seen by walking a tree; gives the tree.
template <class Build>
CopiedWideBvh build_and_check(const Build& build, const mir::WorldGeometry& geometry,
                              const mir::WideBvhOptions& options = {}) {
    CopiedWideBvh bvh = build(geometry, options);
    if (options.splits == 0.0f)
        check_whole(geometry, bvh);
    else
        check_split(geometry, bvh, options.splits);
    check_order(bvh.nodes());
    const mir::WideBvhStatistics count = mir::wide_statistics(bvh.nodes());
    CHECK(count.depth == bvh.depth());
    CHECK(count.depth <= mir::WideBvhOptions::depth_limit);
    CHECK(count.largest_leaf <= options.leaf_size);
    return bvh;
}

/// Bits of segments and rays are those of asking every triangle.
template <class Build>
void check_bits(const Build& build, const World& world, std::uint64_t index,
                const mir::WideBvhOptions& options = {}) {
    const CopiedWideBvh bvh = build_and_check(build, world.geometry, options);
    const std::vector<mir::KdNode> planes = box_planes(bvh);
    check_equal_bits(compare(world, bvh.view(), planes, 10000, index));
    CHECK(wrong_rays(world, bvh.view(), planes, 5000, index + 1) == 0);
}

template <class Build>
void bits_are_those_of_every_triangle(const Build& build) {
    SECTION("at any scale and place") { check_bits(build, soup_anywhere(1), 2); }
    SECTION("among needles") { check_bits(build, needles_anywhere(3), 4); }
    SECTION("where walls lie along the axes") { check_bits(build, sphere_in_box(), 5); }
    SECTION("in a flat scene") { check_bits(build, flat_grid(8, GENERATE(0, 1, 2)), 6); }
    SECTION("among coincident triangles") { check_bits(build, coincident(50), 7); }
    SECTION("among nested triangles") { check_bits(build, nested_triangles(200, 10), 8); }
    SECTION("with leaves of any size") {
        mir::WideBvhOptions options;
        options.leaf_size = GENERATE(1u, 2u, 8u);
        check_bits(build, triangle_soup(150, 9), 10, options);
    }
}

/// Long triangles across all axes, of any width, whose boxes are next to empty, among the triangles
/// of a soup.
inline World diagonals(std::uint32_t count, std::uint64_t index, float scale = 1.0f,
                       mir::Vec3 move = {0, 0, 0}) {
    mir::Random random = test_random(index);
    mir::Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool large = i % 3 == 0;
        const mir::Vec3 a = point_in_cube(random);
        const mir::Vec3 b = large ? -a : a + 0.25f * point_in_cube(random);
        const float width = large ? std::pow(10.0f, -6.0f * random.next()) : 0.25f;
        const mir::Vec3 c = a + random.next() * (b - a) + width * direction(random);
        for (mir::Vec3 p : {a, b, c}) mesh.positions.push_back(move + scale * p);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return world_of(std::move(mesh));
}

template <class Build>
void bits_do_not_depend_on_splits(const Build& build) {
    mir::WideBvhOptions options;
    options.splits = 1.0f;
    SECTION("of a soup") { check_bits(build, soup_anywhere(23), 24, options); }
    SECTION("of needles") { check_bits(build, needles_anywhere(25), 26, options); }
    SECTION("of large triangles across all axes") {
        const auto [scale, x] = GENERATE(table<float, float>(
            {{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e4f, 0.0f}, {1.0f, 100.0f}, {1.0f, 1e4f}}));
        const World world = diagonals(150, 27, scale, {x, 0.3f * x, -x});
        check_bits(build, world, 28, options);
    }
    SECTION("of one triangle many times") { check_bits(build, coincident(50), 29, options); }
    SECTION("with leaves of any size, in flat trees") {
        options.leaf_size = GENERATE(1u, 8u);
        options.max_depth = 1;
        check_bits(build, diagonals(150, 30), 31, options);
    }
    SECTION("of very few triangles") {
        build_and_check(build, needles(GENERATE(1u, 2u, 5u), 100.0f, 32).geometry, options);
    }
    SECTION("in huge and tiny scenes") {
        build_and_check(build, diagonals(300, 33, GENERATE(5e35f, 1e-20f)).geometry, options);
    }
}

/// Splits that the tree could not use would test nothing.
template <class Build>
void splits_are_made_where_boxes_are_empty(const Build& build) {
    mir::WideBvhOptions options;
    options.splits = 0.5f;
    const World world = diagonals(600, 34);
    const CopiedWideBvh bvh = build_and_check(build, world.geometry, options);
    CHECK(bvh.indices().size() > 800);
    const double whole = mir::wide_statistics(build(world.geometry, {}).nodes()).sah_cost();
    CHECK(mir::wide_statistics(bvh.nodes()).sah_cost() < 0.9 * whole);
    const World walls = flat_grid(16, 1);
    CHECK(build(walls.geometry, options).indices().size() == walls.geometry.triangles().size());
}

template <class Build>
void few_triangles_make_whole_trees(const Build& build) {
    const std::uint32_t count = GENERATE(1u, 2u, 3u, 4u, 5u, 8u, 9u, 33u);
    const World world = triangle_soup(count, 11);
    const CopiedWideBvh bvh = build_and_check(build, world.geometry);
    CHECK(bvh.depth() == (count <= 9 ? 1 : 2));
    if (count > 8) return;
    for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot)
        CHECK(bvh.nodes()[0].count[slot] == (slot < count ? 1 : mir::WideNode::empty));
}

template <class Build>
void no_triangle_makes_a_root_without_children(const Build& build) {
    const World world{mir::Scene{}};
    const CopiedWideBvh bvh = build_and_check(build, world.geometry);
    REQUIRE(bvh.nodes().size() == 1);
    for (const std::int32_t c : bvh.nodes()[0].count) CHECK(c == mir::WideNode::empty);
    CHECK_FALSE(mir::is_hidden(bvh.view(), {-1, 0, 0}, {1, 0, 0}));
}

/// Scenes that are hard to cluster, larger than those asked segment by segment.
template <class Build>
void hard_scenes_make_whole_trees(const Build& build) {
    SECTION("soup") {
        const World world = triangle_soup(20000, 12, 0.5f);
        const CopiedWideBvh bvh = build_and_check(build, world.geometry);
        CHECK(bvh.depth() < 12);
    }
    SECTION("needles") {
        build_and_check(build, needles(500, GENERATE(10.0f, 1e4f, 1e7f), 13).geometry);
    }
    SECTION("coincident triangles, dealt out evenly") {
        CHECK(build_and_check(build, coincident(20000).geometry).depth() <= 6);
    }
    SECTION("a flat grid, whose leaves lie apart") {
        const World world = flat_grid(32, GENERATE(0, 1, 2));
        CHECK(mir::wide_statistics(build_and_check(build, world.geometry).nodes()).expected_tests <
              16.0);
    }
    SECTION("far from the origin") {
        build_and_check(build, triangle_soup(700, 14, 1.0f, {1e4f, -1e4f, 3e3f}).geometry);
    }
    SECTION("huge") { build_and_check(build, triangle_soup(700, 15, 5e35f).geometry); }
    SECTION("tiny") { build_and_check(build, triangle_soup(700, 16, 1e-20f).geometry); }
}

template <class Build>
void depth_is_never_exceeded(const Build& build) {
    mir::WideBvhOptions options;
    options.max_depth = GENERATE(1u, 4u, 5u, 6u, 8u, 32u);
    const World world = nested_triangles(3000, GENERATE(30, 150));
    const CopiedWideBvh bvh = build_and_check(build, world.geometry, options);
    // 8 * 8 * 8 * 4 triangles fit below three nodes, 8 * 2048 below four.
    CHECK(bvh.depth() <= std::max(options.max_depth, 4u));
}

template <class Build>
void scale_changes_nothing(const Build& build) {
    // Powers of two scale every number of the construction exactly.
    const CopiedWideBvh one = build(triangle_soup(2000, 17).geometry, {});
    const World scaled = triangle_soup(2000, 17, GENERATE(0x1p-20f, 0x1p60f));
    const CopiedWideBvh other = build(scaled.geometry, {});
    CHECK(equal_bytes(one.indices(), other.indices()));
    CHECK(one.nodes().size() == other.nodes().size());
    mir::WideBvhOptions split;
    split.splits = 0.3f;
    CHECK(equal_bytes(build(needles(200, 100.0f, 35).geometry, split).indices(),
                      build(needles(200, 100.0f, 35, 0x1p60f).geometry, split).indices()));
}

template <class Build>
void what_cannot_be_built_is_refused(const Build& build) {
    CHECK_THROWS_AS(build(triangle_soup(2, 18, 1e37f).geometry, {}), mir::Error);
    mir::WideBvhOptions options;
    SECTION("no triangle in a leaf") { options.leaf_size = 0; }
    SECTION("too many triangles in a leaf") { options.leaf_size = 9; }
    SECTION("no neighbour") { options.radius = 0; }
    SECTION("too many neighbours") { options.radius = 65; }
    SECTION("nodes for nothing") { options.node_cost = 0.0f; }
    SECTION("nodes too dear") { options.node_cost = std::numeric_limits<float>::infinity(); }
    SECTION("splits taken back") { options.splits = -0.1f; }
    SECTION("too many splits") { options.splits = 1.5f; }
    SECTION("splits that are no number") {
        options.splits = std::numeric_limits<float>::quiet_NaN();
    }
    SECTION("no depth") { options.max_depth = 0; }
    SECTION("depth") { options.max_depth = 33; }
    CHECK_THROWS_AS(build(triangle_soup(10, 19).geometry, options), mir::Error);
}

/// All of the above, each by its name.
template <class Build>
void wide_builder_suite(const Build& build) {
    SECTION("bits") { bits_are_those_of_every_triangle(build); }
    SECTION("splits") { bits_do_not_depend_on_splits(build); }
    SECTION("where splits are made") { splits_are_made_where_boxes_are_empty(build); }
    SECTION("few triangles") { few_triangles_make_whole_trees(build); }
    SECTION("no triangle") { no_triangle_makes_a_root_without_children(build); }
    SECTION("hard scenes") { hard_scenes_make_whole_trees(build); }
    SECTION("depth") { depth_is_never_exceeded(build); }
    SECTION("scale") { scale_changes_nothing(build); }
    SECTION("refusals") { what_cannot_be_built_is_refused(build); }
}

/// Whether two trees have the same bytes.
template <class A, class B>
bool same_trees(const A& a, const B& b) {
    return equal_bytes(a.nodes(), b.nodes()) && equal_bytes(a.triangles(), b.triangles()) &&
           equal_bytes(a.indices(), b.indices());
}

/// Scenes on which builders of different machines are compared in every byte.
inline std::vector<World> worlds_to_compare() {
    std::vector<World> worlds;
    worlds.push_back(triangle_soup(30000, 20, 1.0f, {0.25f, 0, 0}));
    worlds.push_back(needles(3000, 1e4f, 21));
    worlds.push_back(coincident(3000));
    worlds.push_back(nested_triangles(3000, 30));
    worlds.push_back(flat_grid(40, 1));
    worlds.emplace_back(mir::builtin::make("sphere"));
    return worlds;
}

}  // namespace mirtest
