// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_traverse.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/scene/world_geometry.hpp"

namespace mir {

/// Asks a kd-tree in host memory what a ray sees first. Model of RayCaster. Same bits as asking
/// every triangle. Geometry and tree must outlive it. Thread-safe.
class KdRayCaster {
 public:
    KdRayCaster(const WorldGeometry& geometry, KdTreeView<Space::host> tree)
        : geometry_(&geometry), tree_(tree) {}

    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray) const {
        const TriangleHit hit = first_hit(tree_, ray);
        if (hit.triangle == TriangleHit::none) return std::nullopt;
        return geometry_->surface_point(hit.triangle, hit.barycentrics, ray.direction);
    }

 private:
    const WorldGeometry* geometry_;
    KdTreeView<Space::host> tree_;
};

static_assert(RayCaster<KdRayCaster>);

}  // namespace mir
