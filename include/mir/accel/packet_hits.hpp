// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/triangle_rows.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/lanes.hpp"

namespace mir::detail {

static_assert(PointPacket::width == lane_count);

/// The common origin of a packet as a triangle's rows see it: row_at() of each.
struct OriginRows {
    float u = 0.0f;
    float v = 0.0f;
    float s = 0.0f;
};

inline OriginRows origin_rows(const TriangleRows& rows, Vec3 origin) {
    return {row_at(rows.u, origin), row_at(rows.v, origin), row_at(rows.s, origin)};
}

/// Distances of the points from a triangle's plane, metres.
inline LaneFloats plane_distances(const TriangleRows& rows, const PointPacket& points) {
    LaneFloats s;
    for (std::uint32_t k = 0; k < lane_count; ++k)
        s.at[k] = row_at(rows.s, {points.x[k], points.y[k], points.z[k]});
    return s;
}

/// Lanes of `open` whose segments from the origin the triangle hits: hits_segment(), bit for bit.
/// Where the ends lie on opposite sides the sign of the crossing's d is that of -s at the origin,
/// which is why the edges are asked for that side alone.
inline std::uint32_t hit_lanes(const TriangleRows& rows, const OriginRows& from,
                               const PointPacket& points, std::uint32_t open) {
    const LaneFloats s_to = plane_distances(rows, points);
    const std::uint32_t crossing_lanes =
        open & lanes_where([&](std::uint32_t k) { return opposite(from.s, s_to.at[k]); });
    if (crossing_lanes == 0) return 0;
    const float side = from.s < 0.0f ? 1.0f : -1.0f;
    return crossing_lanes & lanes_where([&](std::uint32_t k) {
               const Vec3 to{points.x[k], points.y[k], points.z[k]};
               const PlaneCrossing c = crossing(from.u, from.v, from.s, row_at(rows.u, to),
                                                row_at(rows.v, to), s_to.at[k]);
               const float w = strict::sub(strict::sub(c.d, c.u), c.v);
               return static_cast<bool>(static_cast<int>(side * c.u >= 0.0f) &
                                        static_cast<int>(side * c.v >= 0.0f) &
                                        static_cast<int>(side * w >= 0.0f));
           });
}

}  // namespace mir::detail
