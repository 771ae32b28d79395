// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"

#include <cstdint>

namespace mirtest {

/// Makes `p` the end of the packet's segment k.
inline void set_point(mir::PointPacket& points, std::uint32_t k, mir::Vec3 p) {
    points.x[k] = p.x;
    points.y[k] = p.y;
    points.z[k] = p.z;
}

/// Where the packet's segment k ends.
[[nodiscard]] inline mir::Vec3 point_of(const mir::PointPacket& points, std::uint32_t k) {
    return {points.x[k], points.y[k], points.z[k]};
}

}  // namespace mirtest
