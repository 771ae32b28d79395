// SPDX-License-Identifier: MIT
#include "mir/accel/exact/triangle_rows.hpp"

#include "accel/hard_segments.hpp"
#include "conformance/referee.hpp"
#include "conformance/worlds.hpp"
#include "support/catch.hpp"

#include <limits>

namespace {

using mir::Vec3;

/// Corners (0,0,0), (2,0,0), (0,4,0).
mir::TriangleRows right_triangle() {
    return mir::make_triangle_rows({0, 0, 0}, {2, 0, 0}, {0, 4, 0});
}

bool crosses_down(float x, float y) {
    return mir::hits_segment(right_triangle(), {x, y, 1}, {x, y, -1});
}

}  // namespace

TEST_CASE("Rows are barycentric coordinates and a signed distance") {
    const mir::TriangleRows rows = right_triangle();
    const Vec3 p(0.5f, 1.0f, 3.0f);
    CHECK(mir::row_at(rows.u, p) == 0.25f);
    CHECK(mir::row_at(rows.v, p) == 0.25f);
    CHECK(mir::row_at(rows.s, p) == 3.0f);
}

TEST_CASE("A segment crosses a triangle inside its closed edges only") {
    CHECK(crosses_down(0.5f, 0.5f));
    CHECK(crosses_down(0.0f, 0.0f));
    CHECK(crosses_down(2.0f, 0.0f));
    CHECK(crosses_down(1.0f, 2.0f));
    CHECK_FALSE(crosses_down(-0.01f, 0.5f));
    CHECK_FALSE(crosses_down(0.5f, -0.01f));
    CHECK_FALSE(crosses_down(1.01f, 2.0f));
}

TEST_CASE("A segment that ends on a plane or lies in it does not cross it") {
    const mir::TriangleRows rows = right_triangle();
    CHECK_FALSE(mir::hits_segment(rows, {0.5f, 0.5f, 1}, {0.5f, 0.5f, 0}));
    CHECK_FALSE(mir::hits_segment(rows, {0.5f, 0.5f, 0}, {0.5f, 0.5f, -1}));
    CHECK_FALSE(mir::hits_segment(rows, {-1, 0.5f, 0}, {3, 0.5f, 0}));
    CHECK_FALSE(mir::hits_segment(rows, {0.5f, 0.5f, 2}, {0.5f, 0.5f, 1}));
}

TEST_CASE("Triangles without area and ends that are not numbers cross nothing") {
    const float tiny = 1e-30f;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const mir::TriangleRows point = mir::make_triangle_rows({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    const mir::TriangleRows line = mir::make_triangle_rows({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    const mir::TriangleRows speck =
        mir::make_triangle_rows({0, 0, 0}, {tiny * tiny, 0, 0}, {0, tiny * 1e-10f, 0});
    for (const mir::TriangleRows& rows : {point, line, speck}) {
        CHECK_FALSE(mir::hits_segment(rows, {1, 1, 2}, {1, 1, -2}));
        CHECK_FALSE(mir::hits_segment(rows, {2, 0, 1}, {-2, 0, -1}));
    }
    CHECK_FALSE(mir::hits_segment(right_triangle(), {nan, 0.5f, 1}, {0.5f, 0.5f, -1}));
    CHECK_FALSE(mir::hits_segment(right_triangle(), {0.5f, 0.5f, 1}, {0.5f, 0.5f, nan}));
}

TEST_CASE("Segments and triangles give the same bit when the ends change places") {
    const mirtest::World world = mirtest::needle_soup(64, 1);
    const mirtest::World soup = mirtest::triangle_soup(64, 2);
    std::size_t different = 0;
    std::size_t hits = 0;
    for (const mir::WorldGeometry* g : {&world.geometry, &soup.geometry}) {
        mirtest::HardSegments segments(*g, {}, 3);
        for (std::uint32_t i = 0; i < 500000; ++i) {
            const mirtest::HardSegment s = segments.next();
            const std::uint32_t t = i % 64;
            const mir::TriangleRows rows =
                mir::make_triangle_rows(g->corner(t, 0), g->corner(t, 1), g->corner(t, 2));
            const bool hit = mir::hits_segment(rows, s.from, s.to);
            if (hit) ++hits;
            if (hit != mir::hits_segment(rows, s.to, s.from)) ++different;
        }
    }
    CHECK(hits > 1000);
    CHECK(different == 0);
}

TEST_CASE("Segments and triangles agree with the referee away from edges") {
    const mirtest::World world = mirtest::triangle_soup(1, 4);
    const mirtest::Referee referee(world.geometry);
    const mir::TriangleRows rows = mir::make_triangle_rows(
        world.geometry.corner(0, 0), world.geometry.corner(0, 1), world.geometry.corner(0, 2));
    const Vec3 centre = world.geometry.bounds().centre();
    mir::Random random = mirtest::test_random(5);
    std::size_t hits = 0;
    for (int i = 0; i < 200000; ++i) {
        const Vec3 from = centre + 0.3f * mirtest::point_in_cube(random);
        const Vec3 to = centre + 0.3f * mirtest::point_in_cube(random);
        const auto verdict = referee.segment(from, to);
        const bool hit = mir::hits_segment(rows, from, to);
        if (hit) ++hits;
        if (!verdict.doubtful(1e-4)) REQUIRE(hit != verdict.visible());
    }
    CHECK(hits > 1000);
}

TEST_CASE("The closer of two crossings is kept, at equal places the smaller index") {
    const mir::TriangleRows near = mir::make_triangle_rows({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
    const mir::TriangleRows far = right_triangle();
    const Vec3 from(0.25f, 0.25f, 2.0f);
    const Vec3 to(0.25f, 0.25f, -2.0f);
    mir::TriangleHit hit;
    mir::keep_closer(far, from, to, 3, hit);
    CHECK(hit.t == 0.5f);
    mir::keep_closer(near, from, to, 8, hit);
    mir::keep_closer(far, from, to, 3, hit);
    CHECK(hit.triangle == 8);
    CHECK(hit.t == 0.25f);
    CHECK(hit.barycentrics == mir::Vec2(0.25f, 0.25f));
    mir::keep_closer(near, from, to, 9, hit);
    CHECK(hit.triangle == 8);
    mir::keep_closer(near, from, to, 7, hit);
    CHECK(hit.triangle == 7);
}

TEST_CASE("Rays and segments cross the same triangles") {
    const mirtest::World world = mirtest::needle_soup(64, 6);
    mirtest::HardSegments segments(world.geometry, {}, 7);
    for (std::uint32_t i = 0; i < 200000; ++i) {
        const mirtest::HardSegment s = segments.next();
        const auto corner = [&](std::uint32_t k) { return world.geometry.corner(i % 64, k); };
        const mir::TriangleRows rows = mir::make_triangle_rows(corner(0), corner(1), corner(2));
        mir::TriangleHit hit;
        mir::keep_closer(rows, s.from, s.to, 0, hit);
        REQUIRE((hit.triangle == 0) == mir::hits_segment(rows, s.from, s.to));
    }
}
