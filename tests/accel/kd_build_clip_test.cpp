// SPDX-License-Identifier: MIT
#include "conformance/worlds.hpp"
#include "mir/accel/kd/detail/kd_partition.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::Vec3;
namespace kd = mir::detail;

namespace {

struct Corners {
    Vec3 a{0};
    Vec3 b{0};
    Vec3 c{0};
};

/// From fat to needle-like, by the logarithm of the aspect.
Corners random_triangle(mir::Random& random) {
    Corners t;
    t.a = point_in_cube(random);
    t.b = point_in_cube(random);
    const float aspect = std::pow(10.0f, 4.0f * random.next());
    t.c = glm::mix(t.a, t.b, random.next()) + point_in_cube(random) / aspect;
    return t;
}

bool contains(const kd::KdFragment& f, Vec3 p) {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
        inside = inside && f.low[axis] <= p[axis] && p[axis] <= f.high[axis];
    return inside;
}

/// Sorting keys use the last bits, so they have to be free.
bool is_even(const kd::KdFragment& f) {
    const auto is_free = [](kd::Float4 v) {
        const kd::Int4 odd = kd::bits_of(kd::axes_only(v)) & 1;
        return (odd[0] | odd[1] | odd[2]) == 0;
    };
    return is_free(f.low_lanes()) && is_free(f.high_lanes());
}

kd::KdCell cell_of(const kd::KdFragment& f) {
    return {kd::axes_only(f.low_lanes()), kd::axes_only(f.high_lanes())};
}

/// A point of a triangle's accept region: of the accept triangle, moved by at most sigma.
Vec3 accepted_point(const kd::AcceptTriangle& t, double sigma, mir::Random& random) {
    const mir::Vec2 uv = mir::square_to_triangle(random.next_2d());
    const auto u = static_cast<double>(uv.x);
    const auto v = static_cast<double>(uv.y);
    const kd::Double3 on = (1.0 - u - v) * t.a + u * t.b + v * t.c;
    const Vec3 moved(on + sigma * kd::Double3(point_in_cube(random)));
    return moved;
}

kd::KdFragment half(const kd::KdParts& parts, bool below) {
    return below ? parts.below : parts.above;
}

}  // namespace

TEST_CASE("Clipping loses no point where a triangle may be accepted") {
    mir::Random random = test_random(30);
    constexpr float magnitude = 1.0f;
    std::uint64_t lost = 0;
    std::uint64_t kept = 0;
    for (int i = 0; i < 4000; ++i) {
        const Corners c = random_triangle(random);
        const kd::AcceptTriangle accept = kd::accept_triangle(c.a, c.b, c.c, magnitude);
        const kd::KdItem item = kd::make_item(c.a, c.b, c.c, 7, magnitude);
        kd::KdFragment fragment = item.fragment;
        kd::KdCell cell = cell_of(fragment);
        // Cut again and again towards a point of the region, which has to stay in the fragment.
        const Vec3 p = accepted_point(accept, mir::sigma_of(magnitude), random);
        for (int cut = 0; cut < 12; ++cut) {
            const int axis = cut % 3;
            const float share = 0.1f + 0.8f * random.next();
            const float at = kd::even_lanes(
                kd::all_lanes(glm::mix(fragment.low[axis], fragment.high[axis], share)))[0];
            if (!(at > fragment.low[axis] && at < fragment.high[axis])) break;
            const kd::KdParts parts = kd::split_fragment(fragment, item.triangle, cell, axis, at);
            const bool below = p[axis] <= at;
            const bool there =
                (below ? parts.has_below : parts.has_above) && contains(half(parts, below), p);
            ++(there ? kept : lost);
            if (!there) break;
            fragment = half(parts, below);
            CHECK(fragment.triangle == 7);
            CHECK(is_even(fragment));
            (below ? cell.high : cell.low)[axis] = at;
        }
    }
    CHECK(lost == 0);
    CHECK(kept > 30000);
}

TEST_CASE("Boxes of clipped parts are tight") {
    // A diagonal triangle in the unit square, cut at x = 1/4: below, y begins at 3/4.
    const kd::KdItem item = kd::make_item({1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 0, 1.0f);
    const kd::KdParts parts =
        kd::split_fragment(item.fragment, item.triangle, cell_of(item.fragment), 0, 0.25f);
    REQUIRE(parts.has_below);
    REQUIRE(parts.has_above);
    CHECK(parts.below.low[1] == Approx(0.75f).margin(1e-4));
    CHECK(parts.below.high[0] == 0.25f);
    CHECK(parts.above.low[0] == 0.25f);
    CHECK(parts.above.low[1] == Approx(0.0f).margin(1e-4));
    // The lower part again, now with a face of its cell below: only a corner is left.
    kd::KdCell cell = cell_of(item.fragment);
    cell.high[0] = 0.25f;
    const kd::KdParts corner = kd::split_fragment(parts.below, item.triangle, cell, 1, 0.875f);
    REQUIRE(corner.has_below);
    CHECK(corner.below.low[0] == Approx(0.125f).margin(1e-4));
    CHECK(corner.above.low[0] == Approx(0.0f).margin(1e-4));
}

TEST_CASE("A part of a cell that the triangle only seems to reach is left out") {
    // The box reaches into the corner (0, 0) of the square, the triangle does not.
    const kd::KdItem item = kd::make_item({1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 0, 1.0f);
    kd::KdFragment fragment = item.fragment;
    kd::KdCell cell = cell_of(fragment);
    cell.high[0] = 0.5f;
    cell.high[1] = 0.75f;
    fragment.set_box(cell.low, cell.high);
    const kd::KdParts parts = kd::split_fragment(fragment, item.triangle, cell, 0, 0.125f);
    CHECK_FALSE(parts.has_below);
    CHECK(parts.has_above);
}

TEST_CASE("Every fragment goes to the sides that it reaches") {
    const kd::KdItem item = kd::make_item({0, 0, 0}, {1, 0, 0}, {0, 1, 1}, 0, 1.0f);
    kd::KdFragment from[3] = {item.fragment, item.fragment, item.fragment};
    const kd::Float4 low{0, 0, 0, 0};
    from[0].set_box(low, kd::Float4{0.5f, 1, 1, 0});
    from[1].set_box(kd::Float4{0.5f, 0, 0, 0}, kd::Float4{1, 1, 1, 0});
    from[2].set_box(low, kd::Float4{1, 1, 1, 0});
    for (std::uint32_t i = 0; i < 3; ++i) from[i].triangle = i;
    kd::KdFragment below[3];
    kd::KdFragment above[3];
    kd::KdFragment both[3];
    const kd::KdSides sides = kd::deal_fragments(from, 0, 0.5f, below, above, both);
    REQUIRE(sides.below == 1);
    REQUIRE(sides.above == 1);
    REQUIRE(sides.both == 1);
    CHECK(below[0].triangle == 0);
    CHECK(above[0].triangle == 1);
    CHECK(both[0].triangle == 2);
}
