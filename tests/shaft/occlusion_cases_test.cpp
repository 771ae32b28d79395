// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/occlusion.hpp"
#include "shaft/cluster_draws.hpp"
#include "support/catch.hpp"

// Places of VPL, cluster and triangle that are known to be awkward, and those with a plain answer.

namespace {

using mir::ClusterRecord;
using mir::Occlusion;
using mir::TriangleRows;
using mir::Vec3;

mir::Pyramid pyramid_of(Vec3 low, Vec3 high, Vec3 apex) {
    ClusterRecord c;
    c.low = low;
    c.high = high;
    c.luxels = 1;
    return mir::make_pyramid(c, apex, mirtest::float_sigma(2.0f));
}

/// A right triangle in the plane z = 0 whose legs begin at `corner`.
TriangleRows triangle_at(Vec3 corner, float size) {
    return mir::make_triangle_rows(corner, corner + Vec3(size, 0, 0), corner + Vec3(0, size, 0));
}

}  // namespace

TEST_CASE("A triangle ten times the cluster covers it, one beside it misses it") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    const Vec3 low(-0.05f, -0.05f, -1.05f);
    const Vec3 high(0.05f, 0.05f, -0.95f);
    const Vec3 apex(0, 0, 1);
    ClusterRecord c;
    c.low = scale * low;
    c.high = scale * high;
    const auto found = [&](Vec3 corner, float size) {
        const TriangleRows rows =
            mir::make_triangle_rows(scale * corner, scale * (corner + Vec3(size, 0, 0)),
                                    scale * (corner + Vec3(0, size, 0)));
        return mir::occlusion(
            rows, mir::make_pyramid(c, scale * apex, mirtest::float_sigma(2.0f * scale)));
    };
    CHECK(found({-0.3f, -0.3f, 0}, 1) == Occlusion::full);
    CHECK(found({0.1f, -0.3f, 0}, 1) == Occlusion::none);
    CHECK(found({-0.3f, 0.1f, 0}, 1) == Occlusion::none);
    CHECK(found({-0.9f, -0.9f, 0}, 1) == Occlusion::none);
    CHECK(found({-0.3f, -0.3f, -1.5f}, 1) == Occlusion::none);
    CHECK(found({-0.3f, -0.3f, 1.5f}, 1) == Occlusion::none);
    CHECK(found({0, 0, 0}, 1) == Occlusion::partial);
}

TEST_CASE(
    "A triangle through the apex, at an edge, at a corner, or within sigma of it, is partial") {
    const Vec3 low(-0.1f, -0.1f, -1);
    const Vec3 high(0.1f, 0.1f, -1);
    const float tiny = 0.5f * mirtest::float_sigma(2.0f);
    for (const float z : {0.0f, tiny, -tiny})
        for (const Vec3 apex : {Vec3(0.25f, 0.25f, z), Vec3(0.5f, 0, z), Vec3(0, 0, z)})
            CHECK(mir::occlusion(triangle_at({0, 0, 0}, 1), pyramid_of(low, high, apex)) ==
                  Occlusion::partial);
}

TEST_CASE(
    "A cluster in a triangle's plane, or one unit in the last place beside it, is not covered") {
    for (const float z : {0.5f, std::nextafter(0.5f, 0.0f), std::nextafter(0.5f, 1.0f)}) {
        const mir::Pyramid p = pyramid_of({0.1f, 0.1f, z}, {0.2f, 0.2f, z}, {0, 0, 1.5f});
        CHECK(mir::occlusion(triangle_at({0, 0, 0.5f}, 1), p) == Occlusion::partial);
    }
}

TEST_CASE(
    "A triangle that covers a cluster edge to edge is partial, so are two halves of a square") {
    const mir::Pyramid p = pyramid_of({0, 0, -1}, {1, 1, -1}, {0, 0, 1});
    const TriangleRows half = triangle_at({0, 0, 0}, 0.5f);
    const TriangleRows other = mir::make_triangle_rows({0.5f, 0.5f, 0}, {0, 0.5f, 0}, {0.5f, 0, 0});
    CHECK(mir::occlusion(half, p) == Occlusion::partial);
    CHECK(mir::occlusion(other, p) == Occlusion::partial);
    const TriangleRows exact = triangle_at({0, 0, 0}, 1);
    CHECK(mir::occlusion(exact, p) == Occlusion::partial);
}

TEST_CASE("Triangles that are never crossed miss every pyramid") {
    const mir::Pyramid p = pyramid_of({-1, -1, -1}, {1, 1, -0.5f}, {0, 0, 1});
    CHECK(mir::occlusion(mir::uncrossable_rows(), p) == Occlusion::none);
}

TEST_CASE("A cluster of one point is decided where it is clear") {
    const Vec3 point(0.2f, 0.2f, -1);
    const mir::Pyramid p = pyramid_of(point, point, {0.2f, 0.2f, 1});
    CHECK(mir::occlusion(triangle_at({0, 0, 0}, 1), p) == Occlusion::full);
    CHECK(mir::occlusion(triangle_at({0.5f, 0, 0}, 1), p) == Occlusion::none);
    const mir::Pyramid at_apex = pyramid_of(point, point, point);
    CHECK(mir::occlusion(triangle_at({0, 0, 0}, 1), at_apex) == Occlusion::none);
}

TEST_CASE("Nothing is said of edges whose numbers overflow") {
    const mir::TriangleRows rows =
        mir::make_triangle_rows({-1e6f, 0, 0}, {1e6f, 0, 0}, {0, 3.03e-27f, 0});
    const Vec3 apex(0, 1e6f, 1e6f);
    const Vec3 luxel(0, -1e6f, -1e6f);
    REQUIRE(mir::hits_segment(rows, apex, luxel));
    mir::ClusterRecord c;
    c.low = Vec3(0, -1.08e6f, -1e6f);
    c.high = luxel;
    c.luxels = 2;
    CHECK(mir::occlusion(rows, mir::make_pyramid(c, apex, mirtest::float_sigma(1.08e6f))) ==
          Occlusion::partial);
}
