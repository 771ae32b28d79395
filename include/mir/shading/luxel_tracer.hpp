// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/luxel.hpp"
#include "mir/data/specular_plan.hpp"
#include "mir/scene/environment_view.hpp"
#include "mir/shading/ray_numbers.hpp"
#include "mir/shading/specular_tracer.hpp"
#include "mir/shading/surface_table_view.hpp"

namespace mir {

/// What a camera ray sees: a point of a surface, or the background. It may lie behind glass or in a
/// mirror. `ray` is the last edge then, so that the viewer seems to stand where it begins:
/// opposite, where light goes through the surface diffusely.
using SeenLuxel = SpecularEnd;

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
    [[nodiscard]] MIR_HD SeenLuxel operator()(const Ray& ray, SpecularPlan plan = {}) const {
        SeenLuxel seen;
        seen.ray = ray;
        seen.is_background = !find_point(caster, ray, seen.point);
        if (!seen.is_background && surfaces.is_specular(seen.point.material)) {
            RayNumbers numbers(ray, plan.first);
            SpecularTracer{caster, surfaces}.follow(seen, Transport::radiance, numbers, plan.least);
        }
        return seen;
    }
    /// What the luxel at (x, y) sees. Its ray is `rays(x, y)`, and `rays.specular_plan(x, y)`,
    /// where there is one, what its chain begins with.
#if defined(__CUDACC__)
#pragma nv_exec_check_disable
#endif
    template <class Rays>
    [[nodiscard]] MIR_HD SeenLuxel luxel(const Rays& rays, std::uint32_t x, std::uint32_t y) const {
        if constexpr (requires { rays.specular_plan(x, y); })
            return (*this)(rays(x, y), rays.specular_plan(x, y));
        else
            return (*this)(rays(x, y));
    }

    /// Place of what is seen, lifted off its surface; empty where that is the background.
    [[nodiscard]] MIR_HD static Hit hit(const SeenLuxel& seen) {
        return seen.is_background ? Hit{} : Hit{lift(seen.point), seen.point.geometric_normal};
    }
    /// Unit shading normal of the surface that is seen.
    [[nodiscard]] MIR_HD Vec3 normal(const SeenLuxel& seen) const {
        const Vec3 wo = -seen.ray.direction;
        return seen.on_coat ? surfaces.coat_normal(seen.point, wo)
                            : surfaces.seen_normal(seen.point, wo);
    }
    /// Surface that is seen. Of the background it has the radiance as its emission and no more.
    [[nodiscard]] MIR_HD Surface surface(const SeenLuxel& seen,
                                         const EnvironmentView<S>& background = {}) const {
        Surface surface{};
        if (seen.is_background)
            surface.emission = background.radiance(seen.ray.direction);
        else
            surface = surfaces.luxel_surface(seen.point, -seen.ray.direction);
        weaken(seen, surface);
        return surface;
    }
    /// Gives the surface at the end of a chain what the chain leaves of its light and reflection.
    MIR_HD void weaken(const SeenLuxel& seen, Surface& surface) const;
};

template <class R, Space S, Bsdf B>
MIR_HD void LuxelTracer<R, S, B>::weaken(const SeenLuxel& seen, Surface& surface) const {
    if constexpr (SpecularBsdf<B>) {
        const SurfacePoint& p = seen.point;
        const bool ends_specular = !seen.is_background && surfaces.is_specular(p.material);
        if (seen.events == 0 && !ends_specular) return;
        surface.emission = surface.emission * seen.light;
        if (ends_specular)
            surface.bsdf = surfaces.params_of_side(surface.bsdf, p.material, p.front);
        if (seen.on_coat) {
            surface.bsdf = surfaces.coat(p.material, attributes_of(p));
            surface.normal = surfaces.coat_normal(p, surface.wo);
        }
        if (seen.is_through) surface.bsdf = surfaces.through(p.material, attributes_of(p));
        surface.bsdf = B::scaled(surface.bsdf, seen.reflection);
    }
}
template <class R, Space S, class B>
LuxelTracer(R, SurfaceTableView<S, B>) -> LuxelTracer<R, S, B>;

}  // namespace mir
