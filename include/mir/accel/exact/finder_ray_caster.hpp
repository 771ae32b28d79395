// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/find_surface.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/ray_finder.hpp"
#include "mir/scene/world_geometry.hpp"

namespace mir {

/// Asks a ray finder what a ray sees first, and the geometry what that is. Model of PointFinder
/// and, on the host, of RayCaster. Same bits as asking every triangle, on the host and on the
/// device, if the finder has them. Geometry and what the finder reads must outlive it. Thread-safe.
template <RayFinder F>
class FinderRayCaster {
 public:
    static constexpr Space space = F::space;  ///< of the finder and the geometry
    using Mask = typename F::Mask;            ///< of the finder

    /// `view` is what the finder reads: a tree. `mask` says which points of triangles are there.
    MIR_HD FinderRayCaster(const GeometryView<space>& geometry, const typename F::View& view,
                           const Mask& mask = {})
        : geometry_(geometry), finder_{view, mask} {}
    /// The same of the geometry of a scene, which must outlive it.
    FinderRayCaster(const WorldGeometry& geometry, const typename F::View& view,
                    const Mask& mask = {}) requires(space == Space::host)
        : FinderRayCaster(geometry.view(), view, mask) {}

    /// Writes the first surface along the ray to `point`; false when there is none. Surfaces
    /// farther than `reach` metres may not be found.
    [[nodiscard]] MIR_HD bool find_point(const Ray& ray, SurfacePoint& point,
                                         float reach = INFINITY) const {
        return find_surface(finder_, geometry_, ray, point, reach);
    }
    /// The first surface along the ray; none when it leaves the scene. The bits of find_point().
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray, float reach = INFINITY) const
        requires(space == Space::host) {
        SurfacePoint point;
        if (!find_point(ray, point, reach)) return std::nullopt;
        return point;
    }

 private:
    GeometryView<space> geometry_;
    F finder_;
};

}  // namespace mir
