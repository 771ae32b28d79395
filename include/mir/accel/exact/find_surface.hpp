// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_finder.hpp"
#include "mir/scene/geometry_view.hpp"

namespace mir {

/// Lets segments leave a point by an edge where the ray's origin sees them begin. A ray met the
/// point at the distance `t`, metres. `hides(p, q)` says whether two points do not see each other.
///
/// Triangles reach over their edges by what rounding can hide (detail/thick_triangle.hpp). So a ray
/// that passes by the edge of a closed body may meet the inner side of the triangle behind the
/// edge, and what leaves that point would lie inside of the body. From such a point segments leave
/// on the ray, before it arrives, or beside the ray across the edge: a ray in the plane of the
/// edge's other triangle has all its points there.
template <Space S, class Hides>
MIR_HD void keep_in_sight(SurfacePoint& point, const GeometryView<S>& geometry, const Ray& ray,
                          float t, const Hides& hides) {
    if (!hides(ray.origin, lift(point))) return;
    const Vec3 inwards = point.position - geometry.position(point.triangle, point.barycentrics);
    leave_on_ray(point, ray, t);
    SurfacePoint across = point;
    across.position -= inwards;
    if (!hides(ray.origin, lift(across))) point = across;
}

/// Writes the first surface along a ray to `point`; false when there is none. Surfaces farther than
/// `within` metres may not be found. The same bits on host and device. Thread-safe.
template <RayFinder F, Space S>
[[nodiscard]] MIR_HD bool find_surface(const F& finder, const GeometryView<S>& geometry,
                                       const Ray& ray, SurfacePoint& point,
                                       float within = INFINITY) {
    TriangleHit hit;
    if constexpr (ShortRayFinder<F>)
        hit = finder.closest(ray, within);
    else
        hit = finder.closest(ray);
    if (hit.triangle == TriangleHit::none) return false;
    point = geometry.surface_point(hit.triangle, hit.barycentrics, ray);
    if (hit.by_edge)
        keep_in_sight(point, geometry, ray, hit.t,
                      [&finder](Vec3 from, Vec3 to) { return finder.hides(from, to); });
    return true;
}

}  // namespace mir
