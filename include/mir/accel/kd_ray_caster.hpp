// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_ray_finder.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/scene/world_geometry.hpp"

namespace mir {

/// Asks a kd-tree in memory of space `S` what a ray sees first. Model of PointFinder and, on the
/// host, of RayCaster. Same bits as asking every triangle, on the host and on the device. Geometry
/// and tree must outlive it. Thread-safe.
template <Space S>
class KdRayCaster {
 public:
    static constexpr Space space = S;

    MIR_HD KdRayCaster(const GeometryView<S>& geometry, const KdTreeView<S>& tree)
        : geometry_(geometry), finder_{tree} {}
    KdRayCaster(const WorldGeometry& geometry, const KdTreeView<S>& tree) requires(S == Space::host)
        : KdRayCaster(geometry.view(), tree) {}

    /// Writes the first surface along the ray to `point`; false when there is none.
    [[nodiscard]] MIR_HD bool find_point(const Ray& ray, SurfacePoint& point) const {
        const TriangleHit hit = finder_.closest(ray);
        if (hit.triangle == TriangleHit::none) return false;
        point = geometry_.surface_point(hit.triangle, hit.barycentrics, ray.direction);
        return true;
    }
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray) const
        requires(S == Space::host) {
        SurfacePoint point;
        if (!find_point(ray, point)) return std::nullopt;
        return point;
    }

 private:
    GeometryView<S> geometry_;
    KdRayFinder<S> finder_;
};

static_assert(RayCaster<KdRayCaster<Space::host>>);
static_assert(PointFinder<KdRayCaster<Space::host>> && PointFinder<KdRayCaster<Space::device>>);

}  // namespace mir
