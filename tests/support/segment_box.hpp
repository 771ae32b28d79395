// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/world_geometry.hpp"

#include <algorithm>

namespace mirtest {

/// Whether the closed segment and the box grown by `grow` share a point, in long arithmetic.
inline bool meets(const mir::Bounds& box, long double grow, mir::Vec3 from, mir::Vec3 to) {
    long double begin = 0;
    long double end = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const long double origin = from[axis];
        const long double way = static_cast<long double>(to[axis]) - origin;
        const long double low = box.low[axis] - grow - origin;
        const long double high = box.high[axis] + grow - origin;
        if (low > high) return false;
        if (way == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        begin = std::max(begin, std::min(low / way, high / way));
        end = std::min(end, std::max(low / way, high / way));
    }
    return begin <= end;
}

}  // namespace mirtest
