// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/space.hpp"
#include "mir/data/triangle_hit.hpp"

#include <concepts>

namespace mir {

/// Finds the first triangle along a ray, from kernels. The interface of a ray engine that knows
/// nothing of surfaces. `triangle` of the answer is TriangleHit::none for rays that leave the
/// scene. `hides` says whether a triangle lies between two points.
///
/// Axioms: those of RayCaster, once the answer went through find_surface().
template <class F>
concept RayFinder = DeviceCopyable<F> && requires(const F f, const Ray& ray, Vec3 p) {
    { F::space } -> std::convertible_to<Space>;
    { f.closest(ray) } -> std::same_as<TriangleHit>;
    { f.hides(p, p) } -> std::same_as<bool>;
};

/// A RayFinder that can stop early. closest(ray, within) is closest(ray) where that lies within so
/// many metres; beyond, it may find nothing. Detected and used where present.
template <class F>
concept ShortRayFinder = RayFinder<F> && requires(const F f, const Ray& ray, float within) {
    { f.closest(ray, within) } -> std::same_as<TriangleHit>;
};

}  // namespace mir
