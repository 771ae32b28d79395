// SPDX-License-Identifier: MIT
#pragma once

#include "accel/brute_force_rows.hpp"
#include "accel/hard_segments.hpp"
#include "support/catch.hpp"

#include <bit>

// Trees against asking every triangle. Views of trees are asked by is_hidden() and first_hit(),
// found by their argument.

namespace mirtest {

/// Rows of all triangles of a scene, by index.
inline std::vector<mir::TriangleRows> all_rows(const mir::WorldGeometry& geometry) {
    std::vector<mir::TriangleRows> rows;
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t)
        rows.push_back(mir::make_triangle_rows(geometry.corner(t, 0), geometry.corner(t, 1),
                                               geometry.corner(t, 2)));
    return rows;
}

/// Random triangles at one of several scales and distances from the origin, by a generator of
/// Catch.
inline World soup_anywhere(std::uint64_t index) {
    const auto [scale, x] = GENERATE(table<float, float>({{1.0f, 0.0f},
                                                          {1e-3f, 0.0f},
                                                          {1e4f, 0.0f},
                                                          {1.0f, 1000.0f},
                                                          {0.01f, 50.0f},
                                                          {1e-3f, 1e-2f}}));
    UNSCOPED_INFO("scale " << scale << ", moved by " << x);
    return triangle_soup(150, index, scale, {x, 0.3f * x, -x});
}

/// The same with needles.
inline World needles_anywhere(std::uint64_t index) {
    const auto [scale, x] =
        GENERATE(table<float, float>({{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e4f, 0.0f}, {1.0f, 100.0f}}));
    UNSCOPED_INFO("scale " << scale << ", moved by " << x);
    return needle_soup(150, index, scale, {x, 0.3f * x, -x});
}

/// Answers of a tree that differ from asking every triangle.
struct Differences {
    std::size_t asked = 0;
    std::size_t hidden = 0;
    std::size_t wrong = 0;
    std::size_t wrong_backwards = 0;
};

/// `planes` are those of the tree at which some segments are aimed.
template <class View>
Differences compare(const World& world, const View& view, const std::vector<mir::KdNode>& planes,
                    std::size_t count, std::uint64_t index) {
    const std::vector<mir::TriangleRows> rows = all_rows(world.geometry);
    HardSegments segments(world.geometry, planes, index);
    Differences d;
    for (std::size_t i = 0; i < count; ++i) {
        const HardSegment s = segments.next();
        const bool truth = hidden_by_any(rows, view.reach, s.from, s.to);
        ++d.asked;
        d.hidden += truth ? 1 : 0;
        if (is_hidden(view, s.from, s.to) != truth) ++d.wrong;
        if (is_hidden(view, s.to, s.from) != truth) ++d.wrong_backwards;
    }
    return d;
}

inline void check_equal_bits(const Differences& d) {
    INFO(d.hidden << " of " << d.asked << " hidden");
    CHECK(d.hidden > d.asked / 20);
    CHECK(d.hidden < d.asked);
    CHECK(d.wrong == 0);
    CHECK(d.wrong_backwards == 0);
}

/// The same with segments along axes only.
template <class View>
Differences compare_along_axes(const World& world, const View& view, std::size_t count,
                               std::uint64_t index) {
    const std::vector<mir::TriangleRows> rows = all_rows(world.geometry);
    const ScenePlaces places(world.geometry);
    mir::Random random = test_random(index);
    Differences d;
    for (std::size_t i = 0; i < count; ++i) {
        const mir::Vec3 from = places.anywhere(random);
        const mir::Vec3 to = places.along_axis(from, random);
        const bool truth = hidden_by_any(rows, view.reach, from, to);
        ++d.asked;
        d.hidden += truth ? 1 : 0;
        if (is_hidden(view, from, to) != truth) ++d.wrong;
        if (is_hidden(view, to, from) != truth) ++d.wrong_backwards;
    }
    return d;
}

inline bool same_bits(const mir::TriangleHit& a, const mir::TriangleHit& b) {
    const auto same = [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    };
    return a.triangle == b.triangle && same(a.t, b.t) && same(a.barycentrics.x, b.barycentrics.x) &&
           same(a.barycentrics.y, b.barycentrics.y);
}

/// Number of rays whose first triangle is not the one found by asking all, to the last bit.
template <class View>
std::size_t wrong_rays(const World& world, const View& view, const std::vector<mir::KdNode>& planes,
                       std::size_t count, std::uint64_t index) {
    const std::vector<mir::TriangleRows> rows = all_rows(world.geometry);
    HardSegments segments(world.geometry, planes, index);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const HardSegment s = segments.next();
        if (s.from == s.to) continue;
        const mir::Ray ray{s.from, glm::normalize(s.to - s.from)};
        if (!same_bits(first_hit(view, ray), first_of_all(rows, view.reach, ray))) ++wrong;
    }
    return wrong;
}

}  // namespace mirtest
