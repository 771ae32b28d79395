// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/accel/exact/accept_box.hpp"
#include "mir/core/ray.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

namespace mirtest {

inline bool chance(mir::Random& random, float share) { return random.next() < share; }

/// The float nearest to 32 roundings of coordinates up to `magnitude`.
inline float float_sigma(float magnitude) { return static_cast<float>(mir::sigma_of(magnitude)); }

/// A luxel on a random triangle, lifted by that share of what luxels are.
inline mir::Hit random_hit(const mir::WorldGeometry& g, mir::Random& random, float share = 1.0f) {
    const mir::SurfacePoint p = random_surface_point(g, random);
    return {mir::lift(p.position, p.geometric_normal, share * g.ray_offset()), p.geometric_normal};
}

/// Another one in the plane of `hit`, at most `size` away along each axis before it is put there.
inline mir::Hit hit_beside(const mir::Hit& hit, float size, mir::Random& random) {
    const mir::Vec3 aside = size * point_in_cube(random);
    return {hit.position + aside - glm::dot(aside, hit.normal) * hit.normal, hit.normal};
}

/// A box of a cluster as it comes, from flat or a single point to a third of the scene, within
/// [-scale, scale]^3. Not grown and without a half-space: tests ask for segments to its very faces.
inline mir::ClusterRecord random_cluster_box(mir::Random& random, float scale) {
    const mir::Vec3 middle = 0.6f * point_in_cube(random);
    const float size = 0.3f * std::pow(10.0f, -4.0f * random.next());
    mir::ClusterRecord record;
    record.luxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const float half = chance(random, 0.25f) ? 0.0f : size * random.next();
        record.low[axis] = scale * (middle[axis] - half);
        record.high[axis] = scale * (middle[axis] + half);
    }
    return record;
}

/// A VPL anywhere, in the box, or on a face, an edge or a corner of it.
inline mir::Vec3 random_apex(mir::Random& random, const mir::ClusterRecord& record, float scale) {
    mir::Vec3 apex = scale * point_in_cube(random);
    if (chance(random, 0.2f)) {
        const mir::Vec3 share = 0.5f + 0.5f * point_in_cube(random);
        apex = record.low + share * (record.high - record.low);
    }
    const float touching = chance(random, 0.5f) ? 0.5f : 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        if (chance(random, touching))
            apex[axis] = chance(random, 0.5f) ? record.low[axis] : record.high[axis];
    return apex;
}

/// A point of the box, most often on its faces.
inline mir::Vec3 random_luxel(mir::Random& random, const mir::ClusterRecord& record) {
    mir::Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const float x = record.low[axis] + random.next() * (record.high[axis] - record.low[axis]);
        const bool inside = chance(random, 0.2f) && x <= record.high[axis];
        p[axis] = inside ? x : chance(random, 0.5f) ? record.low[axis] : record.high[axis];
    }
    return p;
}

/// Gives a box that is small enough a leaning axis, as if its luxels lay on a slope: a part of the
/// box that holds its centre.
inline void lean(mir::Random& random, mir::ClusterRecord& record, float scale) {
    const mir::Vec3 size = record.high - record.low;
    if (mir::max_abs(size) > scale / 16.0f) return;
    mir::TiltedAxis& tilt = record.tilt;
    tilt.axis = static_cast<std::uint32_t>(3.0f * random.next()) % 3;
    tilt.slope = point_in_cube(random);
    const int axis = static_cast<int>(tilt.axis);
    tilt.slope[axis] = 0.0f;
    const float middle = tilt.along(0.5f * (record.low + record.high));
    const float half = 0.5f * random.next() * random.next() * size[axis];
    tilt.low = middle - half;
    tilt.high = middle + half;
}

/// A luxel of the box, moved into the leaning one.
inline mir::Vec3 random_leaning_luxel(mir::Random& random, const mir::ClusterRecord& record) {
    mir::Vec3 p = random_luxel(random, record);
    const mir::TiltedAxis& tilt = record.tilt;
    if (tilt.axis == mir::TiltedAxis::none) return p;
    const float share = chance(random, 0.3f) ? random.next() : chance(random, 0.5f) ? 0.0f : 1.0f;
    const float wanted = tilt.low + share * (tilt.high - tilt.low);
    p[static_cast<int>(tilt.axis)] += wanted - tilt.along(p);
    return p;
}

}  // namespace mirtest
