// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/triangle_rows.hpp"

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

}  // namespace mir::detail
