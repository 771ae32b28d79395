// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/paths/path.hpp"
#include "mir/scene/camera.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/surface_table.hpp"

#include <limits>
#include <optional>

namespace mir {

/// What full paths run through. A value of references; the scene data must outlive it. Const use
/// from any thread.
template <Bsdf B, RayCaster R, Visibility V>
struct PathWorld {
    using Bsdf = B;

    const WorldGeometry& geometry;
    const LightTable& lights;
    const SurfaceTable<B>& surfaces;
    R caster;
    V visibility;
    Camera camera;
    float aspect = 1.0f;                              ///< width / height of the film
    float bound = std::numeric_limits<float>::max();  ///< of the geometry term x1, x2; m^-2

    /// First surface along a ray as a path vertex.
    [[nodiscard]] std::optional<PathVertex> hit(Ray ray) const {
        const auto p = caster.closest_hit(ray);
        if (!p) return std::nullopt;
        return PathVertex{lift(p->position, p->geometric_normal, geometry.ray_offset()),
                          p->geometric_normal,
                          p->shading_normal,
                          p->barycentrics,
                          p->triangle,
                          p->material};
    }
    [[nodiscard]] const typename B::Params& params(const PathVertex& v) const {
        return surfaces.params(v.material);
    }
};
template <Bsdf B, RayCaster R, Visibility V>
PathWorld(const WorldGeometry&, const LightTable&, const SurfaceTable<B>&, R, V, Camera, float,
          float) -> PathWorld<B, R, V>;

}  // namespace mir
