// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"

#include <cstdint>

namespace mir::detail {

/// The common origin of a packet as a triangle's rows see it: row_at() of each.
struct OriginRows {
    float u = 0.0f;
    float v = 0.0f;
    float s = 0.0f;
};

inline OriginRows origin_rows(const TriangleRows& rows, Vec3 origin) {
    return {row_at(rows.u, origin), row_at(rows.v, origin), row_at(rows.s, origin)};
}

/// Lanes that cross a triangle, and lanes that may do so outside of an edge. A bit
/// each.
struct LaneHits {
    std::uint32_t hit = 0;
    std::uint32_t doubtful = 0;
};

}  // namespace mir::detail
