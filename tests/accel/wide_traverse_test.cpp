// SPDX-License-Identifier: MIT
#include "mir/accel/wide/wide_traverse.hpp"

#include "accel/against_brute_force.hpp"
#include "accel/build_worlds.hpp"
#include "accel/wide_nodes.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/accel/kd/kd_traverse.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

namespace {

using mirtest::HardSegment;
using mirtest::HardSegments;
using mirtest::World;

void check_equal_bits(const World& world, std::uint64_t index, std::size_t count = 20000) {
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    mirtest::check_equal_bits(
        mirtest::compare(world, bvh.view(), mirtest::box_planes(bvh), count, index));
}

std::size_t wrong_rays(const World& world, std::uint64_t index) {
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    return mirtest::wrong_rays(world, bvh.view(), mirtest::box_planes(bvh), 20000, index);
}

/// The boxes of leaves pulled in to the triangles themselves, the mistake that tests have to
/// notice.
std::vector<mir::WideNode> with_exact_leaves(const mir::WorldGeometry& geometry,
                                             const mir::WideBvh& bvh) {
    std::vector<mir::WideNode> nodes(bvh.nodes().begin(), bvh.nodes().end());
    for (mir::WideNode& node : nodes)
        for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
            if (!node.is_leaf(slot)) continue;
            mir::Bounds box;
            for (std::int32_t i = 0; i < node.count[slot]; ++i)
                for (std::uint32_t k = 0; k < 3; ++k)
                    box.add(geometry.corner(
                        bvh.indices()[node.ref[slot] + static_cast<std::uint32_t>(i)], k));
            for (int axis = 0; axis < 3; ++axis)
                node.set_bounds(axis, slot, box.low[axis], box.high[axis]);
        }
    return nodes;
}

mir::KdTree build_kd(const mir::WorldGeometry& geometry) {
    mir::InlineExecutor executor;
    return {geometry, {}, executor};
}

}  // namespace

TEST_CASE("A wide tree hides exactly what asking every triangle hides") {
    SECTION("at any scale and place") { check_equal_bits(mirtest::soup_anywhere(1), 2); }
    SECTION("among needles") { check_equal_bits(mirtest::needles_anywhere(3), 4); }
    SECTION("where walls lie along the axes") { check_equal_bits(mirtest::sphere_in_box(), 5); }
    SECTION("in a flat scene") { check_equal_bits(mirtest::flat_grid(8, 1), 6); }
    SECTION("among coincident triangles") { check_equal_bits(mirtest::coincident(50), 7); }
    SECTION("in one triangle") { check_equal_bits(mirtest::coincident(1), 8); }
    SECTION("among nested triangles") { check_equal_bits(mirtest::nested_triangles(200, 10), 9); }
}

TEST_CASE("A wide tree over the exact boxes of triangles would lose hits") {
    const World world = mirtest::needle_soup(20, 3);
    mir::WideBvhOptions options;
    options.leaf_size = 1;
    const mir::WideBvh good = mirtest::build_wide(world.geometry, options);
    const std::vector<mir::WideNode> nodes = with_exact_leaves(world.geometry, good);
    auto bad = good.view();
    bad.nodes = nodes.data();
    const std::vector<mir::TriangleRows> rows = mirtest::all_rows(world.geometry);
    HardSegments segments(world.geometry, mirtest::box_planes(good), 4);
    std::size_t lost_by_good = 0;
    std::size_t lost_by_bad = 0;
    for (int i = 0; i < 100000; ++i) {
        const HardSegment s = segments.at_corner();
        if (!mirtest::hidden_by_any(rows, bad.reach, s.from, s.to)) continue;
        if (!mir::is_hidden(good.view(), s.from, s.to)) ++lost_by_good;
        if (!mir::is_hidden(bad, s.from, s.to)) ++lost_by_bad;
    }
    CHECK(lost_by_good == 0);
    CHECK(lost_by_bad > 0);
}

TEST_CASE("A wide tree finds the first triangle that asking every triangle finds") {
    SECTION("at any scale and place") { CHECK(wrong_rays(mirtest::soup_anywhere(11), 12) == 0); }
    SECTION("among needles") { CHECK(wrong_rays(mirtest::needle_soup(150, 13), 14) == 0); }
    SECTION("where walls lie along the axes") {
        CHECK(wrong_rays(mirtest::sphere_in_box(), 15) == 0);
    }
    SECTION("among coincident triangles") { CHECK(wrong_rays(mirtest::coincident(50), 16) == 0); }
    SECTION("in a flat scene") { CHECK(wrong_rays(mirtest::flat_grid(8, 2), 17) == 0); }
}

TEST_CASE("A wide tree and a kd-tree have the same bits in built-in scenes") {
    const std::string name = GENERATE("cornell-box", "sphere", "door-ajar", "furnace");
    INFO(name);
    const World world(mir::builtin::make(name));
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    const mir::KdTree tree = build_kd(world.geometry);
    HardSegments segments(world.geometry, mirtest::box_planes(bvh), 18);
    std::size_t hidden = 0;
    std::size_t different = 0;
    std::size_t different_rays = 0;
    for (int i = 0; i < 100000; ++i) {
        const HardSegment s = segments.next();
        const bool truth = mir::is_hidden(tree.view(), s.from, s.to);
        hidden += truth ? 1 : 0;
        if (mir::is_hidden(bvh.view(), s.from, s.to) != truth) ++different;
        if (s.from == s.to) continue;
        const mir::Ray ray{s.from, glm::normalize(s.to - s.from)};
        if (!mirtest::same_bits(mir::first_hit(bvh.view(), ray), mir::first_hit(tree.view(), ray)))
            ++different_rays;
    }
    CHECK(hidden > 5000);
    CHECK(different == 0);
    CHECK(different_rays == 0);
}

TEST_CASE("Segments along axes are answered by a wide tree in scenes of any size") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e13f, 1e18f);
    INFO("scale " << scale);
    const World world = mirtest::triangle_soup(150, 19, scale);
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    mirtest::check_equal_bits(mirtest::compare_along_axes(world, bvh.view(), 5000, 20));
}

TEST_CASE("A deep and lopsided wide tree is walked in full") {
    const World world = mirtest::nested_triangles(3000, 30);
    mir::WideBvhOptions options;
    options.leaf_size = 1;
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry, options);
    CHECK(mir::wide_statistics(bvh.nodes()).depth > 10);
    mirtest::check_equal_bits(
        mirtest::compare(world, bvh.view(), mirtest::box_planes(bvh), 2000, 21));
}

TEST_CASE("Ends outside of a wide tree's reach are cut and see what is in between") {
    const World world = mirtest::sphere_in_box();
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    const float far = GENERATE(3.0f, 1e3f, 1e6f, 1e30f);
    CHECK(mir::is_hidden(bvh.view(), {0.1f, 0.2f, far}, {0.1f, 0.2f, -far}));
    CHECK(mir::is_hidden(bvh.view(), {0.1f, far, 0.2f}, {0.1f, 0.7f, 0.2f}));
    CHECK_FALSE(mir::is_hidden(bvh.view(), {far, 2.0f, 0.0f}, {0.0f, 2.0f, far}));
    CHECK_FALSE(mir::is_hidden(bvh.view(), {far, 0.0f, 0.0f}, {2.0f * far, 0.0f, 0.0f}));
    const mir::TriangleHit hit = mir::first_hit(bvh.view(), {{0.1f, 0.2f, far}, {0, 0, -1}});
    CHECK(hit.triangle < 12);
    CHECK(hit.t == mirtest::Approx(far - 1.0f));
}

TEST_CASE("A wide tree hides nothing from ends that are not numbers or where they coincide") {
    const World world = mirtest::sphere_in_box();
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(mir::is_hidden(bvh.view(), {0.1f, 0.2f, 0.8f}, {0.1f, 0.2f, 0.8f}));
    CHECK_FALSE(mir::is_hidden(bvh.view(), {nan, 0, 0}, {0, 0, -2}));
    CHECK_FALSE(mir::is_hidden(bvh.view(), {0, 0, 0}, {0, nan, -2}));
    CHECK(mir::first_hit(bvh.view(), {{0, nan, 0}, {0, 0, 1}}).triangle == mir::TriangleHit::none);
}

TEST_CASE("A wide tree without triangles hides nothing and is never hit") {
    const World world{mir::Scene{}};
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    CHECK_FALSE(mir::is_hidden(bvh.view(), {0, 0, 0}, {1, 2, 3}));
    CHECK(mir::first_hit(bvh.view(), {{0, 0, 0}, {0, 0, 1}}).triangle == mir::TriangleHit::none);
}
