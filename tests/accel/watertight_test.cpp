// SPDX-License-Identifier: MIT
#include "accel/against_brute_force.hpp"
#include "support/closed_rooms.hpp"

namespace {

struct Leaks {
    std::size_t hits = 0;    ///< through the edges as computed
    std::size_t passed = 0;  ///< segments that no triangle hides
    std::size_t rays = 0;    ///< rays that meet no triangle
};

bool is_inside_edges(const mir::TriangleRows& rows, mirtest::SegmentEnds s) {
    const float s_from = mir::row_at(rows.s, s.from);
    const float s_to = mir::row_at(rows.s, s.to);
    return mir::detail::opposite(s_from, s_to) &&
           mir::detail::is_inside(
               mir::detail::crossing(mir::detail::rows_at_ends(rows, s.from, s.to, s_from, s_to)));
}

Leaks count_leaks(const mirtest::World& world, mir::Vec3 centre, std::size_t count,
                  std::uint64_t index) {
    const std::vector<mir::TriangleRows> rows = mirtest::all_rows(world.geometry);
    mirtest::LeakSegments segments(world.geometry, centre, index);
    Leaks leaks;
    for (std::size_t i = 0; i < count; ++i) {
        const mirtest::SegmentEnds s = segments.next();
        bool hidden = false;
        bool inside = false;
        mir::TriangleHit best;
        for (std::uint32_t t = 0; t < rows.size(); ++t) {
            hidden = hidden || mir::hits_segment(rows[t], s.from, s.to);
            inside = inside || is_inside_edges(rows[t], s);
            mir::keep_closer(rows[t], s.from, s.to, t, best);
        }
        leaks.hits += inside ? 1 : 0;
        leaks.passed += hidden ? 0 : 1;
        leaks.rays += best.triangle == mir::TriangleHit::none ? 1 : 0;
    }
    return leaks;
}

}  // namespace

TEST_CASE("No segment passes between triangles that share an edge or a vertex") {
    const auto [rings, rough, scale, x] =
        GENERATE(table<std::uint32_t, float, float, float>({{2, 0.0f, 1.0f, 0.0f},
                                                            {4, 0.0f, 1.0f, 0.0f},
                                                            {4, 0.4f, 1.0f, 0.0f},
                                                            {6, 0.2f, 1e-6f, 0.0f},
                                                            {6, 0.2f, 1e6f, 0.0f},
                                                            {4, 0.3f, 1.0f, 30.0f},
                                                            {6, 0.3f, 0.01f, 10.0f}}));
    INFO("rings " << rings << ", rough " << rough << ", scale " << scale << ", moved by " << x);
    const mir::Vec3 centre(x, 0.3f * x, -x);
    const mirtest::World world = mirtest::closed_ball(rings, rough, 1, scale, centre);
    constexpr std::size_t count = 100000;
    const Leaks leaks = count_leaks(world, centre, count, 2);
    CHECK(leaks.passed == 0);
    CHECK(leaks.rays == 0);
    // Else the test asks for nothing: without the margins some pass.
    CHECK(leaks.hits < count);
}
