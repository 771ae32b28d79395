// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_traverse.hpp"

#include "accel/against_brute_force.hpp"
#include "accel/simple_kd_tree.hpp"
#include "conformance/worlds.hpp"
#include "mir/accel/kd/kd_packet.hpp"
#include "support/catch.hpp"
#include "support/packet_points.hpp"

namespace {

using mirtest::HardSegment;
using mirtest::HardSegments;
using mirtest::SimpleKdTree;
using mirtest::World;

void check_equal_bits(const World& world, std::uint64_t index, std::size_t count = 20000) {
    const SimpleKdTree tree(world.geometry);
    mirtest::check_equal_bits(mirtest::compare(world, tree.view(), tree.nodes(), count, index));
}

std::size_t wrong_rays(const World& world, std::uint64_t index) {
    const SimpleKdTree tree(world.geometry);
    return mirtest::wrong_rays(world, tree.view(), tree.nodes(), 20000, index);
}

mir::WorldGeometry stacked_squares() {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    for (int i = 0; i < 3; ++i)
        scene.place(mir::builtin::quad("square", grey, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
    return mir::WorldGeometry(scene);
}

}  // namespace

TEST_CASE("A kd-tree hides exactly what asking every triangle hides") {
    SECTION("at any scale and place") { check_equal_bits(mirtest::soup_anywhere(1), 2); }
    SECTION("among needles") { check_equal_bits(mirtest::needles_anywhere(3), 4); }
    SECTION("where walls lie along the axes") { check_equal_bits(mirtest::sphere_in_box(), 5); }
}

TEST_CASE("Segments along axes are answered by a kd-tree in scenes of any size") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e13f, 1e18f);
    INFO("scale " << scale);
    const World world = mirtest::triangle_soup(150, 19, scale);
    const SimpleKdTree tree(world.geometry);
    mirtest::check_equal_bits(mirtest::compare_along_axes(world, tree.view(), 5000, 20));
}

TEST_CASE("A kd-tree over the exact boxes of triangles would lose hits") {
    const World world = mirtest::needle_soup(20, 3);
    const SimpleKdTree good(world.geometry, 1, 12);
    const SimpleKdTree bad(world.geometry, 1, 12, mirtest::Boxes::exact);
    HardSegments segments(world.geometry, bad.nodes(), 4);
    std::size_t lost_by_good = 0;
    std::size_t lost_by_bad = 0;
    for (int i = 0; i < 100000; ++i) {
        const HardSegment s = segments.at_corner();
        if (!mirtest::hidden_by_any(good.triangles(), good.view().reach, s.from, s.to)) continue;
        if (!mir::is_hidden(good.view(), s.from, s.to)) ++lost_by_good;
        if (!mir::is_hidden(bad.view(), s.from, s.to)) ++lost_by_bad;
    }
    CHECK(lost_by_good == 0);
    CHECK(lost_by_bad > 0);
}

TEST_CASE("Packets of a kd-tree answer like its single segments in every bit") {
    const int kind = GENERATE(0, 1, 2);
    const World world = kind == 0   ? mirtest::triangle_soup(150, 6)
                        : kind == 1 ? mirtest::needle_soup(150, 7)
                                    : mirtest::sphere_in_box();
    const SimpleKdTree tree(world.geometry);
    HardSegments segments(world.geometry, tree.nodes(), 8);
    std::size_t wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const mir::Vec3 origin = segments.next().from;
        mir::PointPacket points;
        std::uint32_t alone = 0;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
            const mir::Vec3 p = segments.next().to;
            mirtest::set_point(points, k, p);
            if (!mir::is_hidden(tree.view(), origin, p)) alone |= 1u << k;
        }
        if (mir::visible_in_packet(tree.view(), origin, points, 0xFFFF) != alone) ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("A kd-tree finds the first triangle that asking every triangle finds") {
    SECTION("at any scale and place") { CHECK(wrong_rays(mirtest::soup_anywhere(11), 12) == 0); }
    SECTION("among needles") {
        const World world = mirtest::needle_soup(150, 13);
        CHECK(wrong_rays(world, 14) == 0);
    }
    SECTION("where walls lie along the axes") {
        const World world = mirtest::sphere_in_box();
        CHECK(wrong_rays(world, 15) == 0);
    }
}

TEST_CASE("Of triangles at the same place the one with the smallest index is met") {
    const mir::WorldGeometry geometry = stacked_squares();
    const SimpleKdTree tree(geometry, 1, 6);
    mir::Random random = mirtest::test_random(16);
    for (int i = 0; i < 200; ++i) {
        const mir::Vec3 p = mirtest::point_in_cube(random);
        const mir::TriangleHit hit = mir::first_hit(tree.view(), {{p.x, p.y, 2.0f}, {0, 0, -1}});
        REQUIRE(hit.triangle < 2);
        CHECK(hit.t == mirtest::Approx(2.0f));
    }
}

TEST_CASE("Ends outside of a kd-tree's reach are cut and see what is in between") {
    const World world = mirtest::sphere_in_box();
    const SimpleKdTree tree(world.geometry);
    const float far = GENERATE(3.0f, 1e3f, 1e6f, 1e30f);
    CHECK(mir::is_hidden(tree.view(), {0.1f, 0.2f, far}, {0.1f, 0.2f, -far}));
    CHECK(mir::is_hidden(tree.view(), {0.1f, far, 0.2f}, {0.1f, 0.7f, 0.2f}));
    CHECK_FALSE(mir::is_hidden(tree.view(), {far, 2.0f, 0.0f}, {0.0f, 2.0f, far}));
    CHECK_FALSE(mir::is_hidden(tree.view(), {far, 0.0f, 0.0f}, {2.0f * far, 0.0f, 0.0f}));
    const mir::TriangleHit hit = mir::first_hit(tree.view(), {{0.1f, 0.2f, far}, {0, 0, -1}});
    CHECK(hit.triangle < 12);
    CHECK(hit.t == mirtest::Approx(far - 1.0f));
}

TEST_CASE("Segments without length and ends that are not numbers are hidden by nothing") {
    const World world = mirtest::sphere_in_box();
    const SimpleKdTree tree(world.geometry);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(mir::is_hidden(tree.view(), {0.1f, 0.2f, 0.8f}, {0.1f, 0.2f, 0.8f}));
    CHECK_FALSE(mir::is_hidden(tree.view(), {nan, 0, 0}, {0, 0, -2}));
    CHECK_FALSE(mir::is_hidden(tree.view(), {0, 0, 0}, {0, nan, -2}));
    CHECK(mir::first_hit(tree.view(), {{0, nan, 0}, {0, 0, 1}}).triangle == mir::TriangleHit::none);
}

TEST_CASE("A kd-tree without triangles hides nothing and is never hit") {
    const World world{mir::Scene{}};
    const SimpleKdTree tree(world.geometry);
    CHECK_FALSE(mir::is_hidden(tree.view(), {0, 0, 0}, {1, 2, 3}));
    CHECK(mir::first_hit(tree.view(), {{0, 0, 0}, {0, 0, 1}}).triangle == mir::TriangleHit::none);
}
