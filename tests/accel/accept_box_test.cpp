// SPDX-License-Identifier: MIT
#include "mir/accel/exact/accept_box.hpp"

#include "accel/hard_segments.hpp"
#include "conformance/worlds.hpp"
#include "support/catch.hpp"
#include "support/segment_box.hpp"

namespace {

using mir::Bounds;
using mir::Vec3;

Bounds exact_box(const mir::WorldGeometry& g, std::uint32_t t) {
    Bounds box;
    for (std::uint32_t k = 0; k < 3; ++k) box.add(g.corner(t, k));
    return box;
}

/// Accepted segments, and those of them that miss a box.
struct Misses {
    std::size_t accepted = 0;
    std::size_t accept_box = 0;  ///< shrunk by what is reserved for traversal
    std::size_t exact_box = 0;
};

Misses count_misses(const mir::WorldGeometry& g, std::size_t count, std::uint64_t index) {
    const float magnitude = mir::magnitude_of(g.bounds());
    const long double reserved = 14.0L * 0x1p-24L * magnitude;
    mirtest::HardSegments segments(g, {}, index);
    Misses misses;
    for (std::size_t i = 0; i < count; ++i) {
        const mirtest::HardSegment s = i % 2 == 0 ? segments.next() : segments.at_corner();
        if (mir::max_abs(s.from) > mir::reach_of(magnitude)) continue;
        if (mir::max_abs(s.to) > mir::reach_of(magnitude)) continue;
        for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
            const Vec3 a = g.corner(t, 0);
            const Vec3 b = g.corner(t, 1);
            const Vec3 c = g.corner(t, 2);
            if (!mir::hits_segment(mir::make_triangle_rows(a, b, c), s.from, s.to)) continue;
            ++misses.accepted;
            const Bounds box = mir::accept_box(a, b, c, magnitude);
            if (!mirtest::meets(box, -reserved, s.from, s.to)) ++misses.accept_box;
            if (!mirtest::meets(exact_box(g, t), 0, s.from, s.to)) ++misses.exact_box;
        }
    }
    return misses;
}

}  // namespace

TEST_CASE("Accepted segments meet the accept box and not always the triangle's own") {
    const auto [scale, x] = GENERATE(table<float, float>(
        {{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e4f, 0.0f}, {1.0f, 30.0f}, {1e-2f, 30.0f}}));
    const bool needles = GENERATE(false, true);
    INFO("scale " << scale << ", moved by " << x << (needles ? ", needles" : ""));
    const Vec3 move(x, 0.3f * x, -x);
    const mirtest::World world = needles ? mirtest::needle_soup(20, 1, scale, move)
                                         : mirtest::triangle_soup(20, 2, scale, move);
    const Misses misses = count_misses(world.geometry, 40000, 3);
    INFO(misses.accepted << " accepted");
    CHECK(misses.accepted > 1000);
    CHECK(misses.accept_box == 0);
    CHECK(misses.exact_box > 0);
}

TEST_CASE("An accept box holds its triangle and stays within the overshoot of it") {
    const mirtest::World world = mirtest::needle_soup(200, 4);
    const float magnitude = mir::magnitude_of(world.geometry.bounds());
    const auto sigma = static_cast<float>(mir::sigma_of(magnitude));
    for (std::uint32_t t = 0; t < 200; ++t) {
        const auto corner = [&](std::uint32_t k) { return world.geometry.corner(t, k); };
        const Bounds box = mir::accept_box(corner(0), corner(1), corner(2), magnitude);
        const float grown = mir::overshoot(corner(0), corner(1), corner(2), magnitude);
        const Bounds exact = exact_box(world.geometry, t);
        CHECK(grown >= sigma);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(box.low[axis] <= exact.low[axis] - 0.9f * sigma);
            CHECK(box.high[axis] >= exact.high[axis] + 0.9f * sigma);
            CHECK(box.low[axis] >= exact.low[axis] - grown - 1e-6f * magnitude);
            CHECK(box.high[axis] <= exact.high[axis] + grown + 1e-6f * magnitude);
        }
    }
}

TEST_CASE("Well-shaped triangles overshoot by little and needles by more") {
    const float regular = mir::overshoot({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1.0f);
    const float needle = mir::overshoot({0, 0, 0}, {1, 0, 0}, {0.5f, 1e-3f, 0}, 1.0f);
    CHECK(regular < 2e-5f);
    CHECK(needle > 100.0f * regular);
}

TEST_CASE("Accept boxes do not leave the reach of the scene") {
    const Bounds box = mir::accept_box({0, 0, 0}, {1, 1, 1}, {0.5f, 0.5f, 0.5000001f}, 1.0f);
    CHECK(mir::max_abs(box.low) < 1.50001f);
    CHECK(mir::max_abs(box.high) < 1.50001f);
}

TEST_CASE("Triangles without area have boxes around their corners") {
    const Bounds box = mir::accept_box({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, 2.0f);
    CHECK(mir::max_abs(box.low) < 1e-5f);
    CHECK(mir::max_abs(box.high - Vec3(2.0f)) < 1e-5f);
}
