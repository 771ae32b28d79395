// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/detail/origin_rows.hpp"
#include "mir/accel/exact/detail/packet_avx512.hpp"
#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/lanes.hpp"
#include "mir/scene/opacity.hpp"

#include <cmath>

namespace mir::detail {

static_assert(PointPacket::width == lane_count);

/// The end that the segments of some packets share, and their doubt at edges. Segments within that
/// doubt are tested one by one.
struct SharedEnd {
    Vec3 origin{0};  ///< metres
    EdgeDoubt doubt;
};

/// Of segments to points of the box between `low` and `high`, metres.
inline SharedEnd shared_end(Vec3 origin, Vec3 low, Vec3 high) {
    const float size = larger(max_abs(origin), larger(max_abs(low), max_abs(high)));
    return {origin, edge_doubt(size, larger(max_abs(low - origin), max_abs(high - origin)))};
}

/// Of segments to the points `active` of `packets` packets, a bit each, packet after packet.
inline SharedEnd shared_end(Vec3 origin, const PointPacket* points, std::uint32_t active) {
    Vec3 low(INFINITY);
    Vec3 high(-INFINITY);
    for (std::uint32_t rest = active; rest != 0;) {
        const std::uint32_t k = pop_lowest(rest);
        const PointPacket& packet = points[k / lane_count];
        const std::uint32_t lane = k % lane_count;
        const Vec3 p{packet.x[lane], packet.y[lane], packet.z[lane]};
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return shared_end(origin, low, high);
}

/// hits_segment() of the lanes of `lanes`.
inline std::uint32_t hit_one_by_one(const TriangleRows& rows, Vec3 origin,
                                    const PointPacket& points, std::uint32_t lanes) {
    std::uint32_t hit = 0;
    while (lanes != 0) {
        const std::uint32_t k = pop_lowest(lanes);
        if (hits_segment(rows, origin, {points.x[k], points.y[k], points.z[k]})) hit |= 1u << k;
    }
    return hit;
}

/// The lanes of a packet, by the edges as computed. Where the ends lie on opposite sides the sign
/// of the crossing's d is that of -s at the origin, which is why the edges are asked for that side
/// alone.
template <InstructionSet Set>
LaneHits sort_lanes(const TriangleRows& rows, const OriginRows& from, const PointPacket& points,
                    float doubt) {
    const float side = from.s < 0.0f ? 1.0f : -1.0f;
    LaneTruths inside;
    LaneTruths near;
    for (std::uint32_t k = 0; k < lane_count; ++k) {
        const Vec3 to{points.x[k], points.y[k], points.z[k]};
        const float s_to = row_at(rows.s, to);
        const PlaneCrossing c =
            crossing({from.u, from.v, from.s, row_at(rows.u, to), row_at(rows.v, to), s_to});
        const float u = side * c.u;
        const float v = side * c.v;
        const float w = side * c.w();
        const int apart = static_cast<int>(opposite(from.s, s_to));
        inside.at[k] = -(apart & static_cast<int>(u >= 0.0f) & static_cast<int>(v >= 0.0f) &
                         static_cast<int>(w >= 0.0f));
        near.at[k] = -(apart & static_cast<int>(u >= -doubt) & static_cast<int>(v >= -doubt) &
                       static_cast<int>(w >= -doubt));
    }
    return {bits_of<Set>(inside), bits_of<Set>(near)};
}

/// Lanes of `open` whose segments the triangle hits: hits_segment(), bit for bit. `from` are the
/// triangle's rows there.
template <InstructionSet Set = InstructionSet::baseline>
std::uint32_t hit_lanes(const TriangleRows& rows, const OriginRows& from, const SharedEnd& end,
                        const PointPacket& points, std::uint32_t open) {
    const float doubt = end.doubt.of(rows);
    LaneHits lanes;
#if defined(__x86_64__)
    if constexpr (Set == InstructionSet::avx512)
        lanes = sort_lanes_by_avx512(rows, from, points, doubt);
    else
#endif
        lanes = sort_lanes<Set>(rows, from, points, doubt);
    const std::uint32_t doubtful = lanes.doubtful & ~lanes.hit & open;
    if (doubtful != 0) lanes.hit |= hit_one_by_one(rows, end.origin, points, doubtful);
    return open & lanes.hit;
}

/// Lanes of packet `p`, out of a bit for each lane of some packets.
inline std::uint32_t lanes_of_packet(std::uint32_t lanes, std::uint32_t p) {
    return lanes >> p * lane_count & ((1u << lane_count) - 1u);
}

/// hit_lanes() of `Packets` packets, a bit for each lane, packet after packet.
template <InstructionSet Set, std::uint32_t Packets>
std::uint32_t hit_lanes_of(const TriangleRows& rows, const SharedEnd& end,
                           const PointPacket* points, std::uint32_t open) {
#if defined(__x86_64__)
    if constexpr (Set == InstructionSet::avx512) {
        const LaneHits lanes =
            sort_lanes_by_avx512<Packets>(rows, end.origin, points, end.doubt.of(rows));
        std::uint32_t hit = lanes.hit;
        const std::uint32_t doubtful = lanes.doubtful & ~hit & open;
        if (doubtful != 0)
            for (std::uint32_t p = 0; p < Packets; ++p)
                hit |= hit_one_by_one(rows, end.origin, points[p], lanes_of_packet(doubtful, p))
                       << p * lane_count;
        return open & hit;
    }
#endif
    const OriginRows from = origin_rows(rows, end.origin);
    std::uint32_t hit = 0;
    for (std::uint32_t p = 0; p < Packets; ++p)
        hit |= hit_lanes<Set>(rows, from, end, points[p], lanes_of_packet(open, p))
               << p * lane_count;
    return hit;
}

/// Lanes of `hit`, those that hit_lanes() found for triangle number `triangle`, that it stops. One
/// by one: lanes that hit a triangle that is not opaque are few.
inline std::uint32_t stopped_lanes(const TriangleRows& rows, std::uint32_t triangle, Vec3 origin,
                                   const PointPacket& points, std::uint32_t hit,
                                   const OpacityView<Space::host>& opacity) {
    if (opacity.stops_all(triangle)) return hit;
    std::uint32_t stopped = 0;
    for (std::uint32_t rest = hit; rest != 0;) {
        const std::uint32_t k = pop_lowest(rest);
        const Vec3 to{points.x[k], points.y[k], points.z[k]};
        if (hits_segment(rows, origin, to, triangle, opacity.between(origin, to)))
            stopped |= 1u << k;
    }
    return stopped;
}

}  // namespace mir::detail
