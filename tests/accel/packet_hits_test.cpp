// SPDX-License-Identifier: MIT
#include "mir/accel/packet_hits.hpp"

#include "conformance/worlds.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace {

using mir::PointPacket;
using mir::Vec3;

/// On a lattice of few places, so that segments meet edges, corners and planes, and ends and
/// weights are zeros of both signs.
Vec3 lattice_point(mir::Random& random) {
    const auto coordinate = [&] { return std::floor(5.0f * random.next()) - 2.0f; };
    return {coordinate(), coordinate(), coordinate()};
}

/// Some are no numbers.
PointPacket lattice_packet(mir::Random& random) {
    PointPacket points;
    for (std::uint32_t k = 0; k < PointPacket::width; ++k) {
        const Vec3 p = lattice_point(random);
        points.x[k] = random.next() < 0.02f ? std::numeric_limits<float>::quiet_NaN() : p.x;
        points.y[k] = p.y;
        points.z[k] = random.next() < 0.02f ? std::numeric_limits<float>::infinity() : p.z;
    }
    return points;
}

/// Lanes out of `open` of which hits_segment() says so.
std::uint32_t one_by_one(const mir::TriangleRows& rows, Vec3 from, const PointPacket& points,
                         std::uint32_t open) {
    std::uint32_t hit = 0;
    for (std::uint32_t k = 0; k < PointPacket::width; ++k)
        if (mir::hits_segment(rows, from, {points.x[k], points.y[k], points.z[k]})) hit |= 1u << k;
    return hit & open;
}

struct Drawn {
    mir::TriangleRows rows;
    Vec3 from;
    PointPacket points[2];
    std::uint32_t open;
};

Drawn draw(mir::Random& random) {
    Drawn d;
    d.rows = mir::make_triangle_rows(lattice_point(random), lattice_point(random),
                                     lattice_point(random));
    d.from = lattice_point(random);
    for (PointPacket& points : d.points) points = lattice_packet(random);
    const auto half = [&] { return static_cast<std::uint32_t>(65536.0f * random.next()); };
    d.open = half() | half() << 16;
    return d;
}

/// How often a packet or a pair of them says something else than its segments, and in `hits` how
/// many lanes hit.
template <mir::InstructionSet Set>
std::uint32_t count_different(std::uint32_t draws, std::uint64_t& hits) {
    mir::Random random = mirtest::test_random(1);
    std::uint32_t different = 0;
    for (std::uint32_t i = 0; i < draws; ++i) {
        const Drawn d = draw(random);
        const std::uint32_t first = one_by_one(d.rows, d.from, d.points[0], d.open & 0xFFFFu);
        const std::uint32_t second = one_by_one(d.rows, d.from, d.points[1], d.open >> 16);
        const std::uint32_t pair =
            mir::detail::hit_lanes_of<Set, 2>(d.rows, d.from, d.points, d.open);
        const std::uint32_t alone = mir::detail::hit_lanes<Set>(
            d.rows, mir::detail::origin_rows(d.rows, d.from), d.points[0], d.open & 0xFFFFu);
        different += pair != (first | second << 16) || alone != first ? 1u : 0u;
        hits += static_cast<std::uint64_t>(std::popcount(pair));
    }
    return different;
}

}  // namespace

TEST_CASE("Packets hit a triangle where their segments do, bit for bit") {
    constexpr std::uint32_t draws = 20000;
    for (const mir::InstructionSet wanted : mirtest::instruction_sets()) {
        std::uint32_t different = draws;
        std::uint64_t hits = 0;
        mir::run_with(wanted, [&](auto set) { different = count_different<set()>(draws, hits); });
        CAPTURE(static_cast<int>(wanted));
        CHECK(different == 0);
        CHECK(hits > draws);
    }
}
