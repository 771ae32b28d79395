// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/data/luxel.hpp"
#include "mir/scene/environment_view.hpp"
#include "mir/shading/surface_table_view.hpp"

namespace mir {

/// What a camera ray sees first: a point of a surface, or the background.
struct SeenLuxel {
    Ray ray;                    ///< that met the point, or that left the scene
    SurfacePoint point;         ///< means nothing where the background is seen
    bool is_background = true;  ///< the ray met no surface
};

/// Says what camera rays see; all that asks goes through here.
///
/// Luxels of a G-buffer, probes of the image, the camera's end of paths and the reference so agree
/// in every bit, on the host and in kernels. A value of views; `R` is a PointFinder or, on the
/// host, any RayCaster. Const use from any thread.
template <class R, Space S, Bsdf B>
struct LuxelTracer {
    static_assert(CastsRaysFrom<R, S>,
                  "mir: camera rays and paths in a kernel need a ray caster with find_point() that "
                  "reads the same memory, such as KdRayCaster<Space::device>");

    using Surface = mir::Surface<typename B::Params>;  ///< what shading knows of a luxel

    R caster;                         ///< what rays meet
    SurfaceTableView<S, B> surfaces;  ///< materials and their textures

    /// What a camera ray sees.
    [[nodiscard]] MIR_HD SeenLuxel operator()(const Ray& ray) const {
        SeenLuxel seen;
        seen.ray = ray;
        seen.is_background = !find_point(caster, ray, seen.point);
        return seen;
    }

    /// Place of what is seen, lifted off its surface; empty where that is the background.
    [[nodiscard]] MIR_HD static Hit hit(const SeenLuxel& seen) {
        return seen.is_background ? Hit{} : Hit{lift(seen.point), seen.point.geometric_normal};
    }
    /// Unit shading normal of the surface that is seen.
    [[nodiscard]] MIR_HD Vec3 normal(const SeenLuxel& seen) const {
        return surfaces.seen_normal(seen.point, -seen.ray.direction);
    }
    /// Surface that is seen. Of the background it has the radiance as its emission and no more.
    [[nodiscard]] MIR_HD Surface surface(const SeenLuxel& seen,
                                         const EnvironmentView<S>& background = {}) const {
        if (!seen.is_background) return surfaces.luxel_surface(seen.point, -seen.ray.direction);
        Surface none{};
        none.emission = background.radiance(seen.ray.direction);
        return none;
    }
};
template <class R, Space S, class B>
LuxelTracer(R, SurfaceTableView<S, B>) -> LuxelTracer<R, S, B>;

}  // namespace mir
