// SPDX-License-Identifier: MIT
#include "accel/hard_segments.hpp"
#include "mir/accel/wide/split_triangles.hpp"
#include "support/catch.hpp"
#include "support/segment_box.hpp"

namespace {

using mir::Bounds;
using mir::detail::CutTriangle;
using mir::detail::PartBox;
using Boxes = std::vector<Bounds>;

/// A triangle of a scene as it is, and as segments are accepted.
struct Corners {
    mir::Vec3 a;
    mir::Vec3 b;
    mir::Vec3 c;
};

Corners corners_of(const mir::WorldGeometry& g, std::uint32_t t) {
    return {g.corner(t, 0), g.corner(t, 1), g.corner(t, 2)};
}

CutTriangle whole(const mir::detail::AcceptTriangle& t) { return {t, box_of(t)}; }

/// Boxes of the parts of a triangle that is cut `splits` times.
Boxes parts_of(const CutTriangle& t, std::uint32_t splits, const mir::WorldGeometry& g,
               double sigma) {
    const Bounds& all = g.bounds();
    const mir::detail::SplitPlanes planes =
        mir::detail::split_planes(all.low, mir::max_abs(all.high - all.low));
    Boxes boxes;
    const std::uint32_t count = mir::detail::cut_into_parts(
        t, splits, planes,
        [&](std::uint32_t, const PartBox& part) { boxes.push_back(grown(part, sigma)); });
    CHECK(count == boxes.size());
    CHECK(count <= splits + 1);
    return boxes;
}

/// Accepted segments, and those of them that miss all parts.
struct Misses {
    std::size_t accepted = 0;
    std::size_t parts = 0;      ///< shrunk by what is reserved for traversal
    std::size_t undilated = 0;  ///< parts of the triangle itself, not grown
};

bool meets_any(const Boxes& boxes, long double grow, const mirtest::HardSegment& s) {
    return std::any_of(boxes.begin(), boxes.end(),
                       [&](const Bounds& b) { return mirtest::meets(b, grow, s.from, s.to); });
}

/// A triangle as it is tested, and the boxes of its parts.
struct Split {
    mir::TriangleRows rows;
    Boxes parts;
    Boxes undilated;
};

std::vector<Split> split_all(const mir::WorldGeometry& g, std::uint32_t splits) {
    const float magnitude = mir::magnitude_of(g.bounds());
    std::vector<Split> all;
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
        const auto [a, b, c] = corners_of(g, t);
        const CutTriangle accept = whole(mir::detail::accept_triangle(a, b, c, magnitude));
        if (!is_within(accept.box, mir::reach_of(magnitude))) continue;
        const CutTriangle exact =
            whole({mir::detail::Double3(a), mir::detail::Double3(b), mir::detail::Double3(c)});
        all.push_back({mir::make_triangle_rows(a, b, c),
                       parts_of(accept, splits, g, mir::sigma_of(magnitude)),
                       parts_of(exact, splits, g, 0.0)});
    }
    return all;
}

Misses count_misses(const mirtest::World& world, std::uint32_t splits, std::uint64_t index) {
    const mir::WorldGeometry& g = world.geometry;
    const float magnitude = mir::magnitude_of(g.bounds());
    const long double reserved = 14.0L * 0x1p-24L * magnitude;
    const std::vector<Split> triangles = split_all(g, splits);
    mirtest::HardSegments segments(g, {}, index);
    Misses misses;
    for (std::size_t i = 0; i < 40000; ++i) {
        const mirtest::HardSegment s = i % 2 == 0 ? segments.next() : segments.at_corner();
        if (mir::max_abs(s.from) > mir::reach_of(magnitude)) continue;
        if (mir::max_abs(s.to) > mir::reach_of(magnitude)) continue;
        for (const Split& t : triangles) {
            if (!mir::hits_segment(t.rows, s.from, s.to)) continue;
            ++misses.accepted;
            misses.parts += meets_any(t.parts, -reserved, s) ? 0 : 1;
            misses.undilated += meets_any(t.undilated, 0, s) ? 0 : 1;
        }
    }
    return misses;
}

}  // namespace

TEST_CASE("Accepted segments meet a part of the accept triangle, not always one of the triangle") {
    const auto [scale, x] = GENERATE(table<float, float>(
        {{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e4f, 0.0f}, {1.0f, 30.0f}, {1e-2f, 30.0f}}));
    const bool needles = GENERATE(false, true);
    const std::uint32_t splits = GENERATE(1u, 40u);
    INFO("scale " << scale << ", moved by " << x << (needles ? ", needles" : "") << ", cut "
                  << splits << " times");
    const mir::Vec3 move(x, 0.3f * x, -x);
    const mirtest::World world = needles ? mirtest::needle_soup(20, 51, scale, move)
                                         : mirtest::triangle_soup(20, 52, scale, move);
    const Misses misses = count_misses(world, splits, 53);
    INFO(misses.accepted << " accepted");
    CHECK(misses.accepted > 1000);
    CHECK(misses.parts == 0);
    CHECK(misses.undilated > 0);
}

TEST_CASE("Boxes of parts lie in the accept box and shrink with the number of splits") {
    const mirtest::World world = mirtest::needle_soup(50, 54);
    const mir::WorldGeometry& g = world.geometry;
    const float magnitude = mir::magnitude_of(g.bounds());
    const auto area = [](const Bounds& box) {
        const mir::Vec3 e = box.high - box.low;
        return e.x * e.y + e.y * e.z + e.z * e.x;
    };
    float whole_area = 0.0f;
    float parts_area = 0.0f;
    for (std::uint32_t t = 0; t < 50; ++t) {
        const auto [a, b, c] = corners_of(g, t);
        const CutTriangle accept = whole(mir::detail::accept_triangle(a, b, c, magnitude));
        if (!is_within(accept.box, mir::reach_of(magnitude))) continue;
        const Bounds box = mir::accept_box(a, b, c, magnitude);
        whole_area += area(box);
        for (const Bounds& part : parts_of(accept, 15, g, mir::sigma_of(magnitude))) {
            parts_area += area(part);
            CHECK(glm::all(glm::lessThanEqual(box.low, part.low)));
            CHECK(glm::all(glm::lessThanEqual(part.high, box.high)));
        }
    }
    CHECK(parts_area < 0.3f * whole_area);
}

TEST_CASE(
    "Triangles are cut at the coarsest planes of Morton's curve, the middle of the scene first") {
    const mir::detail::SplitPlanes planes = mir::detail::split_planes({0, 0, 0}, 1.0f);
    const auto coarsest = [&](mir::detail::Double3 low, mir::detail::Double3 high) {
        return planes.coarsest_in({low, high});
    };
    const auto middle = coarsest({0.1, 0.3, 0.3}, {0.9, 0.4, 0.6});
    CHECK(middle.axis == 0);
    CHECK(middle.at == 0.5);
    CHECK(middle.weight == 1.0f);
    const auto quarter = coarsest({0.1, 0.2, 0.3}, {0.2, 0.3, 0.4});
    CHECK(quarter.axis == 1);
    CHECK(quarter.at == 0.25);
    CHECK(quarter.weight == 0.5f);
    CHECK_FALSE(coarsest({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}).exists());
    CHECK_FALSE(
        mir::detail::split_planes({0, 0, 0}, 0.0f).coarsest_in({{0, 0, 0}, {1, 1, 1}}).exists());
}
