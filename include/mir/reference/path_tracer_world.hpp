// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/shading/scene_light.hpp"
#include "mir/shading/surface_table.hpp"

namespace mir {

/// What the paths of a PathTracer run through. A value of views for host and device; what they read
/// must outlive it. Const use from any thread.
template <Bsdf B, class R, Visibility V>
struct PathTracerWorld {
    static constexpr Space space = space_of_lights<V>;  ///< memory that the views read
    static_assert(CastsRaysFrom<R, space>,
                  "mir: paths in a kernel need a ray caster with find_point() that reads the same "
                  "memory, such as KdRayCaster<Space::device>");

    GeometryView<space> geometry;         ///< triangles
    LightTableView<space> lights;         ///< what shines
    SurfaceTableView<space, B> surfaces;  ///< how they reflect
    R caster;                             ///< finds what paths meet, from many threads at once
    V visibility;                         ///< asked about lights, from many threads at once

    /// Of views that lie in the same memory.
    PathTracerWorld(const GeometryView<space>& geometry_view,
                    const LightTableView<space>& light_table,
                    const SurfaceTableView<space, B>& surface_table, R ray_caster, V sight)
        : geometry(geometry_view),
          lights(light_table),
          surfaces(surface_table),
          caster(ray_caster),
          visibility(sight) {}
    /// Of what the host has, which must outlive it.
    PathTracerWorld(const WorldGeometry& world_geometry, const LightTable& light_table,
                    const SurfaceTable<B>& surface_table, R ray_caster,
                    V sight) requires(space == Space::host)
        : PathTracerWorld(world_geometry.view(), light_table.view(), surface_table.view(),
                          ray_caster, sight) {}
};

}  // namespace mir
