// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/micro/ray_gather.hpp"
#include "mir/micro/surfel_places.hpp"

namespace mir {

/// Rays to the triangles of a scene that see the light of discs there. What a ray engine traces is
/// exact and much faster than a walk down the discs; masks count. Solid angles are not read.
/// Thread-safe as the caster is.
template <RayCaster R>
struct TriangleRays {
    using Caster = R;  ///< what traces

    R caster;                              ///< of the scene
    const SurfelPlaces* places = nullptr;  ///< of its discs

    /// What the ray sees first.
    [[nodiscard]] SurfelHit operator()(const SurfelRay& ray) const {
        const auto met = caster.closest_hit(Ray{ray.origin, ray.direction});
        if (!met) return {};
        return {glm::length(met->position - ray.origin),
                places->leaf(met->triangle, met->barycentrics), met->front};
    }
};

/// Light that reaches a luxel from discs, by rays to the triangles. Found as RayGather does.
template <RayCaster R, Bsdf B>
struct TriangleGather {
    TriangleRays<R> rays;                      ///< what is seen
    const SurfelRadiance* radiance = nullptr;  ///< of nodes
    GatherOptions options;                     ///< must have passed check()

    /// Radiance towards the viewer, W m^-2 sr^-1. The shift of all directions is drawn from
    /// `random`.
    [[nodiscard]] Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                 Random random) const {
        return detail::GatherRays<TriangleRays<R>>{rays, options}.template light<B>(radiance, hit,
                                                                                    s, random);
    }
};

}  // namespace mir
