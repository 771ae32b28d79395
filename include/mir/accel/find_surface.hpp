// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_finder.hpp"
#include "mir/scene/geometry_view.hpp"

namespace mir {

/// Writes the first surface along a ray to `point`; false when there is none. The same bits on host
/// and device. Thread-safe.
///
/// Triangles reach over their edges by what rounding can hide (detail/thick_triangle.hpp). So a ray
/// that passes by the edge of a closed body may meet the inner side of the triangle behind the
/// edge, and what leaves that point would lie inside of the body. A point by an edge that the ray's
/// origin does not see, once it is lifted, is therefore passed over.
template <RayFinder F, Space S>
[[nodiscard]] MIR_HD bool find_surface(const F& finder, const GeometryView<S>& geometry,
                                       const Ray& ray, SurfacePoint& point) {
    // At a vertex several triangles may be passed over; what is left after so many is nothing.
    constexpr int most_tries = 8;
    float after = -1.0f;
    for (int i = 0; i < most_tries; ++i) {
        const TriangleHit hit = finder.closest(ray, after);
        if (hit.triangle == TriangleHit::none) return false;
        point = geometry.surface_point(hit.triangle, hit.barycentrics, ray);
        if (!hit.by_edge || !finder.hides(ray.origin, lift(point))) return true;
        after = hit.t;
    }
    return false;
}

}  // namespace mir
