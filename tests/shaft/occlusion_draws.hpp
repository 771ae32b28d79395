// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/exact/occlusion.hpp"
#include "shaft/cluster_draws.hpp"

#include <array>
#include <cmath>

namespace mirtest {

/// A triangle, a VPL and a box; a segment between the last two passes next to an edge.
struct OcclusionDraw {
    mir::TriangleRows rows;
    mir::ClusterRecord cluster;
    mir::Vec3 apex{0};
};

/// From regular to needles of aspect 10^6.
inline std::array<mir::Vec3, 3> triangle_of_any_aspect(mir::Random& random) {
    const mir::Vec3 a = 0.8f * point_in_cube(random);
    const float size = 0.5f * std::pow(10.0f, -3.0f * random.next());
    const float thin = chance(random, 0.5f) ? 1.0f : std::pow(10.0f, -6.0f * random.next());
    const mir::Vec3 along = size * direction(random);
    const mir::Vec3 apex = a + random.next() * along + thin * size * direction(random);
    return {a, a + along, apex};
}

/// Behind the target, at times next to it, and never far outside of the scene.
inline mir::Vec3 point_beyond(mir::Random& random, mir::Vec3 apex, mir::Vec3 target) {
    const float share =
        chance(random, 0.2f) ? 1.0f + 1e-3f * random.next() : 1.0f + 1.5f * random.next();
    const mir::Vec3 p = apex + share * (target - apex);
    return mir::max_abs(p) < 1.0f ? p : apex + 1.01f * (target - apex);
}

/// The box has the point as a corner, or around itself.
inline mir::ClusterRecord box_at(mir::Random& random, mir::Vec3 p) {
    const float size = 0.2f * std::pow(10.0f, -7.0f * random.next());
    mir::ClusterRecord c;
    c.luxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const float below = chance(random, 0.6f) ? 0.0f : size * random.next();
        const float above = chance(random, 0.6f) ? 0.0f : size * random.next();
        c.low[axis] = p[axis] - below;
        c.high[axis] = p[axis] + above;
    }
    return c;
}

/// All that is drawn lies within 1.5 times `scale`, the largest coordinate of the scene.
inline OcclusionDraw occlusion_draw(mir::Random& random, float scale) {
    const std::array<mir::Vec3, 3> t = triangle_of_any_aspect(random);
    OcclusionDraw d;
    d.rows = mir::make_triangle_rows(scale * t[0], scale * t[1], scale * t[2]);
    const float share = 1.2f * random.next() - 0.1f;
    const std::uint32_t k = random.next() < 0.5f ? 0 : 1;
    const float aside =
        (chance(random, 0.3f) ? -1.0f : 1.0f) * std::pow(10.0f, -8.0f * random.next() - 0.5f);
    const mir::Vec3 edge = (1.0f - share) * t[k] + share * t[k + 1];
    const mir::Vec3 target = edge + aside * (t[2 - 2 * k] - edge);
    mir::Vec3 apex = point_in_cube(random);
    if (chance(random, 0.2f)) {  // almost in the plane of the triangle
        const float u = 2.0f * random.next() - 1.0f;
        apex = t[0] + u * (t[1] - t[0]) + 0.5f * (t[2] - t[0]) + 1e-4f * random.next() * apex;
    }
    if (mir::max_abs(apex) > 1.0f) apex /= mir::max_abs(apex);
    d.apex = scale * apex;
    d.cluster = box_at(random, point_beyond(random, apex, target));
    d.cluster.low *= scale;
    d.cluster.high *= scale;
    return d;
}

/// The same with a box that leans, where it is small enough for that.
inline OcclusionDraw leaning_draw(mir::Random& random, float scale) {
    OcclusionDraw d = occlusion_draw(random, scale);
    lean(random, d.cluster, scale);
    return d;
}

}  // namespace mirtest
