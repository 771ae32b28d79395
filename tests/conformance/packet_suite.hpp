// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/referee.hpp"
#include "conformance/worlds.hpp"
#include "mir/concepts/visibility.hpp"
#include "support/catch.hpp"
#include "support/packet_points.hpp"

#include <cmath>
#include <limits>

// The axiom of PacketVisibility: bit i equals visible(origin, point i). Ray engines evaluate
// packets and single rays in different orders, so a segment that meets an edge or ends on a surface
// within rounding may be seen either way; such ties are looked for, must be ties to the referee,
// and may make up one lane in ten thousand of those that were aimed at edges.

namespace mirtest {

/// Packets asked, and lanes in which the two faces of the model differ.
struct PacketCount {
    std::size_t lanes = 0;
    std::size_t seen = 0;
    std::size_t different = 0;
    std::size_t sure_and_different = 0;  ///< not a tie
};

/// Margin of the referee below which a segment is a tie: some roundings of single precision.
inline constexpr double tie_margin = 4e-6;

template <mir::PacketVisibility V>
void compare_packet(const V& visibility, const Referee& referee, mir::Vec3 origin,
                    const mir::PointPacket& points, std::uint32_t active, PacketCount& count) {
    const std::uint32_t packet = visibility.visible_packet(origin, points, active);
    for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
        const bool in_packet = (packet >> k & 1u) != 0;
        const mir::Vec3 point = point_of(points, k);
        const bool asked = (active >> k & 1u) != 0;
        const bool single = asked && visibility.visible(origin, point);
        ++count.lanes;
        count.seen += single ? 1 : 0;
        if (in_packet == single) continue;
        ++count.different;
        if (!asked || !referee.segment(origin, point).doubtful(tie_margin))
            ++count.sure_and_different;
    }
    // Bits beyond the packet's width belong to nobody.
    if (packet >> mir::PointPacket::width != 0) ++count.sure_and_different;
}

/// Points all over the place, some lanes switched off and filled with what is not a number.
template <mir::PacketVisibility V>
PacketCount scattered_packets(const V& visibility, const Referee& referee, std::size_t packets) {
    mir::Random random = test_random(11);
    PacketCount count;
    for (std::size_t i = 0; i < packets; ++i) {
        const mir::Vec3 origin = point_in_cube(random);
        const auto active = static_cast<std::uint32_t>(random.next() * 65536.0f);
        mir::PointPacket points;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
            const mir::Vec3 p = point_in_cube(random);
            const bool on = (active >> k & 1u) != 0;
            set_point(points, k, on ? p : mir::Vec3(std::numeric_limits<float>::quiet_NaN()));
        }
        compare_packet(visibility, referee, origin, points, active, count);
    }
    return count;
}

/// Neighbouring points of a plane, as a block of luxels is.
template <mir::PacketVisibility V>
PacketCount coherent_packets(const V& visibility, const Referee& referee, std::size_t packets) {
    mir::Random random = test_random(12);
    PacketCount count;
    for (std::size_t i = 0; i < packets; ++i) {
        const mir::Vec3 origin = point_in_cube(random);
        const mir::Vec3 corner = point_in_cube(random);
        const mir::Frame frame = mir::Frame::around(direction(random));
        const float step = 0.05f * random.next();
        mir::PointPacket points;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
            const float row = std::floor(static_cast<float>(k) / 4.0f);
            const float column = static_cast<float>(k % 4);
            set_point(points, k,
                      corner + step * column * frame.tangent + step * row * frame.bitangent);
        }
        compare_packet(visibility, referee, origin, points, 0xFFFF, count);
    }
    return count;
}

/// Segments that pass through, or end on, vertices and edges: where a different order of
/// operations would show first.
template <mir::PacketVisibility V>
PacketCount edge_packets(const V& visibility, const mir::WorldGeometry& geometry,
                         std::size_t packets) {
    const Referee referee(geometry);
    mir::Random random = test_random(13);
    const auto triangles = static_cast<float>(geometry.triangles().size());
    PacketCount count;
    for (std::size_t i = 0; i < packets; ++i) {
        const mir::Vec3 origin = i % 8 == 0 ? mir::Vec3(0.0f) : point_in_cube(random);
        mir::PointPacket points;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
            const auto t = static_cast<std::uint32_t>(random.next() * triangles);
            const float along = std::floor(static_cast<float>(k) / 4.0f) / 3.0f;
            const mir::Vec3 on_edge = (1.0f - along) * geometry.corner(t, k % 3) +
                                      along * geometry.corner(t, (k + 1) % 3);
            // Half of the segments end on the edge, half go through it.
            const float reach = k % 2 == 0 ? 1.0f : 1.5f;
            set_point(points, k, origin + reach * (on_edge - origin));
        }
        set_point(points, 0, origin);
        compare_packet(visibility, referee, origin, points, 0xFFFF, count);
    }
    return count;
}

/// `ties` lanes in ten thousand may be ties.
inline void check_packets(const PacketCount& count, std::size_t ties) {
    INFO(count.different << " of " << count.lanes << " lanes differ, " << count.seen
                         << " are visible");
    CHECK(count.seen > 0);
    CHECK(count.seen < count.lanes);
    CHECK(count.sure_and_different == 0);
    CHECK(count.different * 10000 <= count.lanes * ties);
}

template <class Engine>
void packet_suite(std::size_t packets = 2000) {
    SECTION("scattered packets answer like single segments") {
        const World world = triangle_soup(150, 14);
        const Engine engine(world.geometry);
        check_packets(scattered_packets(engine.visibility(), Referee(world.geometry), packets), 0);
    }
    SECTION("coherent packets answer like single segments") {
        const World world = triangle_soup(150, 15);
        const Engine engine(world.geometry);
        check_packets(coherent_packets(engine.visibility(), Referee(world.geometry), packets), 0);
    }
    SECTION(
        "packets aimed at the edges of a closed mesh answer like single segments but for ties") {
        const World world = sphere_in_box();
        const Engine engine(world.geometry);
        check_packets(edge_packets(engine.visibility(), world.geometry, packets), 1);
    }
    SECTION("a packet without active lanes sees nothing") {
        const World world = triangle_soup(10, 16);
        const Engine engine(world.geometry);
        const mir::PointPacket points{};
        CHECK(engine.visibility().visible_packet({0, 0, 3}, points, 0) == 0);
    }
}

}  // namespace mirtest
