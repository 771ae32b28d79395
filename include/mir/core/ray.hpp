// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

namespace mir {

/// Half line origin + t direction, t > 0. `direction` has unit length; metres.
struct Ray {
    Vec3 origin{0};            ///< world space, metres
    Vec3 direction{0, 0, -1};  ///< unit
};

/// Where a ray met the scene. Normals are unit: the geometric one against the ray, the other on its
/// side. `front` says whether that is the side on which vertices turn counter-clockwise.
struct SurfacePoint {
    /// World space, metres; on the surface, not lifted. It keeps off the triangle's edges by four
    /// times `offset` where the triangle is wide enough (GeometryView::place()).
    Vec3 position{0};
    /// Distance by which segments that leave it are lifted, metres; lift() takes at least
    /// least_offset().
    float offset = 0.0f;
    Vec3 geometric_normal{0, 0, 1};  ///< of the triangle
    Vec3 shading_normal{0, 0, 1};    ///< interpolated from the vertices; normal maps are not in it
    Vec2 barycentrics{0};            ///< weights of the triangle's second and third vertex
    std::uint32_t triangle = 0;      ///< index into WorldGeometry
    std::uint32_t material = 0;      ///< index into Scene::materials
    bool front = true;               ///< counter-clockwise side
    Vec2 texture_coordinates{0};     ///< interpolated; (0, 0) where the mesh has none
    Rgb color{1.0f, 1.0f, 1.0f};     ///< of the vertices; multiplies the base colour
    /// In the triangle's plane along rising u, not unit; zero where textures have no direction.
    Vec3 tangent{0};
    bool mirrored_texture = false;  ///< u, v and the front's normal are left-handed with v up
    bool before_plane = false;      ///< leave_on_ray() has moved it off the triangle's plane
};

/// Lifts a point off its surface so that segments leaving it miss the surface. It moves by `offset`
/// metres along the unit normal of the side it is seen from. `offset` is that of the point:
/// GeometryView::offset_at().
MIR_HD inline Vec3 lift(Vec3 position, Vec3 normal, float offset) {
    return position + offset * normal;
}

/// Least distance, metres, by which a point at `position` may be lifted. It is more than twice what
/// rounding displaces a plane and a point there (accel/detail/thick_triangle.hpp).
MIR_HD inline float least_offset(Vec3 position) { return 0x1p-19f * max_abs(position); }

/// A surface point where segments leave it.
MIR_HD inline Vec3 lift(const SurfacePoint& p) {
    return lift(p.position, p.geometric_normal, larger(p.offset, least_offset(p.position)));
}

/// Moves a point that a ray met at `t`, metres, back along the ray. It then lies four offsets
/// before the surface's plane, but at most half of the distance back.
MIR_HD inline void leave_on_ray(SurfacePoint& p, const Ray& ray, float t) {
    p.offset = larger(p.offset, least_offset(p.position));
    const float cosine = larger(fabsf(glm::dot(p.geometric_normal, ray.direction)), 1e-6f);
    const float back = smaller(larger(4.0f * p.offset / cosine, 0x1p-20f * t), 0.5f * t);
    const Vec3 place = ray.origin + (t - back) * ray.direction;
    p.position = place - p.offset * p.geometric_normal;
    p.before_plane = true;
}

/// Turns a point over to the other side of its surface. It is as if a ray had met it there.
MIR_HD inline void turn_over(SurfacePoint& p) {
    p.geometric_normal = -p.geometric_normal;
    p.shading_normal = -p.shading_normal;
    p.front = !p.front;
    // As far behind its plane as leave_on_ray() put it before.
    if (p.before_plane) p.offset = 8.0f * larger(p.offset, least_offset(p.position));
}

}  // namespace mir
