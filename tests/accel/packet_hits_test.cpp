// SPDX-License-Identifier: MIT
#include "mir/accel/exact/packet_hits.hpp"

#include "conformance/worlds.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/packet_points.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using mir::PointPacket;
using mir::Vec3;

/// On a lattice of few places, so that segments meet edges, corners and planes, and ends and
/// weights are zeros of both signs.
Vec3 lattice_point(mir::Random& random, float spacing) {
    const auto coordinate = [&] { return spacing * (std::floor(7.0f * random.next()) - 3.0f); };
    return {coordinate(), coordinate(), coordinate()};
}

/// The same; some are no numbers.
Vec3 hard_point(mir::Random& random, float spacing) {
    Vec3 p = lattice_point(random, spacing);
    if (random.next() < 0.02f) p.x = std::numeric_limits<float>::quiet_NaN();
    if (random.next() < 0.02f) p.z = std::numeric_limits<float>::infinity();
    return p;
}

PointPacket hard_packet(mir::Random& random, float spacing) {
    PointPacket points;
    for (std::uint32_t k = 0; k < PointPacket::width; ++k)
        mirtest::set_point(points, k, hard_point(random, spacing));
    return points;
}

/// Lanes out of `open` of which hits_segment() says so.
std::uint32_t one_by_one(const mir::TriangleRows& rows, Vec3 from, const PointPacket& points,
                         std::uint32_t open) {
    std::uint32_t hit = 0;
    for (std::uint32_t k = 0; k < PointPacket::width; ++k)
        if (mir::hits_segment(rows, from, mirtest::point_of(points, k))) hit |= 1u << k;
    return hit & open;
}

struct Drawn {
    mir::TriangleRows rows;
    Vec3 from;
    PointPacket points[2];
    std::uint32_t open;
    std::uint32_t hit;  ///< what segments say, one by one, of both packets
};

Drawn draw(mir::Random& random, float spacing) {
    Drawn d;
    const auto corner = [&] { return lattice_point(random, spacing); };
    d.rows = mir::make_triangle_rows(corner(), corner(), corner());
    d.from = hard_point(random, spacing);
    for (PointPacket& points : d.points) points = hard_packet(random, spacing);
    const auto half = [&] { return static_cast<std::uint32_t>(65536.0f * random.next()); };
    d.open = half() | half() << 16;
    d.hit = one_by_one(d.rows, d.from, d.points[0], d.open & 0xFFFFu) |
            one_by_one(d.rows, d.from, d.points[1], d.open >> 16) << 16;
    return d;
}

std::vector<Drawn> draw_many(std::size_t count, float spacing, std::uint64_t seed) {
    mir::Random random = mirtest::test_random(seed);
    std::vector<Drawn> drawn;
    for (std::size_t i = 0; i < count; ++i) drawn.push_back(draw(random, spacing));
    return drawn;
}

/// Draws of which segments say something else than of their counterparts.
std::size_t count_unlike(const std::vector<Drawn>& drawn, const std::vector<Drawn>& others) {
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) unlike += drawn[i].hit != others[i].hit ? 1 : 0;
    return unlike;
}

/// How often a packet or a pair of them says something else than its segments.
template <mir::InstructionSet Set>
std::uint32_t count_different(const std::vector<Drawn>& drawn) {
    std::uint32_t different = 0;
    for (const Drawn& d : drawn) {
        const mir::detail::SharedEnd end = mir::detail::shared_end(d.from, d.points, d.open);
        const std::uint32_t pair = mir::detail::hit_lanes_of<Set, 2>(d.rows, end, d.points, d.open);
        const std::uint32_t alone = mir::detail::hit_lanes<Set>(
            d.rows, mir::detail::origin_rows(d.rows, d.from), end, d.points[0], d.open & 0xFFFFu);
        different += pair != d.hit || alone != (d.hit & 0xFFFFu) ? 1u : 0u;
    }
    return different;
}

}  // namespace

TEST_CASE("Packets hit a triangle where their segments do, bit for bit") {
    // Places are exact; rounded; so close that products vanish; so far that products overflow.
    const auto [seed, spacing] =
        GENERATE(table<std::uint64_t, float>({{1, 1.0f}, {2, 0.1f}, {3, 0x1p-70f}, {4, 0x1p125f}}));
    CAPTURE(spacing);
    const std::vector<Drawn> drawn = draw_many(20000, spacing, seed);
    std::size_t hits = 0;
    for (const Drawn& d : drawn) hits += static_cast<std::size_t>(std::popcount(d.hit));
    CHECK(hits > drawn.size());
    // Else it would be the same test again.
    if (spacing != 1.0f) CHECK(count_unlike(drawn, draw_many(20000, 1.0f, seed)) > 100);
    for (const mir::InstructionSet set : mirtest::instruction_sets())
        mir::run_with(set, [&](auto s) {
            INFO("instruction set " << static_cast<int>(set));
            CHECK(count_different<decltype(s)::value>(drawn) == 0);
        });
}
