// SPDX-License-Identifier: MIT
#pragma once

#include "shaft/cluster_draws.hpp"

#include <algorithm>
#include <limits>

namespace mirtest {

/// A box and a shaft that may meet.
struct ShaftDraw {
    mir::ClusterRecord cluster;
    mir::Vec3 apex{0};
    mir::Vec3 luxel{0};
    mir::Bounds node;
};

/// The box holds the point at a random share of the segment, flush with it on half of its sides.
inline mir::Bounds box_on_segment(mir::Random& random, mir::Vec3 from, mir::Vec3 to, float scale) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float kind = random.next();
    const float t = kind < 0.1f ? 0.0f : kind < 0.2f ? 1.0f : kind < 0.5f ? 0.5f : random.next();
    mir::Bounds box;
    for (int axis = 0; axis < 3; ++axis) {
        const long double way = static_cast<long double>(to[axis]) - from[axis];
        const auto x = static_cast<float>(from[axis] + t * way);
        const long double exact = from[axis] + t * way;
        const float size = scale * random.next();
        box.low[axis] = x > exact ? std::nextafter(x, -infinity) : x;
        box.high[axis] = x < exact ? std::nextafter(x, infinity) : x;
        if (chance(random, 0.3f)) box.low[axis] -= size;
        if (chance(random, 0.3f)) box.high[axis] += size;
    }
    return box;
}

inline ShaftDraw draw_shaft(mir::Random& random, float scale) {
    ShaftDraw d;
    d.cluster = random_cluster_box(random, scale);
    d.apex = random_apex(random, d.cluster, scale);
    d.luxel = random_luxel(random, d.cluster);
    d.node = box_on_segment(random, d.apex, d.luxel, scale);
    return d;
}

/// By how much of the way the shaft misses the box; negative when it meets it.
inline long double gap(const ShaftDraw& d) {
    long double begin = 0;
    long double end = 1;
    const auto from = [&](long double t) { begin = std::max(begin, t); };
    const auto until = [&](long double t) { end = std::min(end, t); };
    // t slope <= limit
    const auto require = [&](long double slope, long double limit) {
        if (slope > 0) until(limit / slope);
        if (slope < 0) from(limit / slope);
        if (slope == 0 && limit < 0) from(2);
    };
    for (int axis = 0; axis < 3; ++axis) {
        const long double q = d.apex[axis];
        require(d.cluster.low[axis] - q, d.node.high[axis] - q);
        require(q - d.cluster.high[axis], q - d.node.low[axis]);
    }
    return begin - end;
}

}  // namespace mirtest
