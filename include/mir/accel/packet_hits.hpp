// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/origin_rows.hpp"
#include "mir/accel/detail/packet_avx512.hpp"
#include "mir/accel/triangle_rows.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/lanes.hpp"
#include "mir/scene/alpha_mask.hpp"

namespace mir::detail {

static_assert(PointPacket::width == lane_count);

/// Lanes of `open` whose segments from the origin the triangle hits: hits_segment(), bit for bit.
/// Where the ends lie on opposite sides the sign of the crossing's d is that of -s at the origin,
/// which is why the edges are asked for that side alone.
template <InstructionSet Set = InstructionSet::baseline>
std::uint32_t hit_lanes(const TriangleRows& rows, const OriginRows& from, const PointPacket& points,
                        std::uint32_t open) {
#if defined(__x86_64__)
    if constexpr (Set == InstructionSet::avx512)
        return open & hit_lanes_by_avx512(rows, from, points);
#endif
    const float side = from.s < 0.0f ? 1.0f : -1.0f;
    return open & lanes_where<Set>([&](std::uint32_t k) {
               const Vec3 to{points.x[k], points.y[k], points.z[k]};
               const float s_to = row_at(rows.s, to);
               const PlaneCrossing c =
                   crossing(from.u, from.v, from.s, row_at(rows.u, to), row_at(rows.v, to), s_to);
               const float w = strict::sub(strict::sub(c.d, c.u), c.v);
               return (static_cast<int>(opposite(from.s, s_to)) &
                       static_cast<int>(side * c.u >= 0.0f) & static_cast<int>(side * c.v >= 0.0f) &
                       static_cast<int>(side * w >= 0.0f)) != 0;
           });
}

/// Lanes of packet `p`, out of a bit for each lane of some packets.
inline std::uint32_t lanes_of_packet(std::uint32_t lanes, std::uint32_t p) {
    return lanes >> p * lane_count & ((1u << lane_count) - 1u);
}

/// hit_lanes() of `Packets` packets, a bit for each lane, packet after packet.
template <InstructionSet Set, std::uint32_t Packets>
std::uint32_t hit_lanes_of(const TriangleRows& rows, Vec3 origin, const PointPacket* points,
                           std::uint32_t open) {
#if defined(__x86_64__)
    if constexpr (Set == InstructionSet::avx512)
        return open & hit_lanes_by_avx512<Packets>(rows, origin, points);
#endif
    const OriginRows from = origin_rows(rows, origin);
    std::uint32_t hit = 0;
    for (std::uint32_t p = 0; p < Packets; ++p)
        hit |= hit_lanes<Set>(rows, from, points[p], lanes_of_packet(open, p)) << p * lane_count;
    return hit;
}

/// Lanes of `hit`, those that hit_lanes() found for triangle number `triangle`, where it is there.
/// One by one: lanes that hit a masked triangle are few.
inline std::uint32_t solid_lanes(const TriangleRows& rows, std::uint32_t triangle, Vec3 origin,
                                 const PointPacket& points, std::uint32_t hit,
                                 const AlphaMaskView<Space::host>& mask) {
    if (!mask.exists()) return hit;
    std::uint32_t solid = 0;
    for (std::uint32_t rest = hit; rest != 0;) {
        const std::uint32_t k = pop_lowest(rest);
        const Vec3 to{points.x[k], points.y[k], points.z[k]};
        if (hits_segment(rows, origin, to, triangle, mask)) solid |= 1u << k;
    }
    return solid;
}

}  // namespace mir::detail
