// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/space.hpp"

#include <concepts>
#include <optional>

namespace mir {

/// Finds what a ray sees first.
///
/// Axioms (tests/conformance/ray_caster_suite.hpp): callable from many threads at once; agrees with
/// brute force on random triangles; nothing is returned for rays that leave the scene.
template <class R>
concept RayCaster = std::copy_constructible<R> && requires(const R r, Ray ray) {
    { r.closest_hit(ray) } -> std::same_as<std::optional<SurfacePoint>>;
};

/// A RayCaster that can stop early. closest_hit(ray, reach) is closest_hit(ray) where that lies
/// within `reach` metres; beyond, it may find nothing. Detected and used where present.
template <class R>
concept ShortRayCaster = RayCaster<R> && requires(const R r, Ray ray, float reach) {
    { r.closest_hit(ray, reach) } -> std::same_as<std::optional<SurfacePoint>>;
};

/// The interface of a RayCaster for kernels, which know no std::optional. find_point() writes what
/// the ray sees first and returns whether there is anything.
///
/// Axioms: those of RayCaster.
template <class R>
concept PointFinder = DeviceCopyable<R> && requires(const R r, const Ray& ray, SurfacePoint& p) {
    { R::space } -> std::convertible_to<Space>;
    { r.find_point(ray, p) } -> std::same_as<bool>;
};

/// A PointFinder that can stop early, as ShortRayCaster.
template <class R>
concept ShortPointFinder = PointFinder<R> &&
    requires(const R r, const Ray& ray, float reach, SurfacePoint& p) {
    { r.find_point(ray, p, reach) } -> std::same_as<bool>;
};

/// Finds surface points in code that reads memory of space `S`. Either a PointFinder that reads it
/// too or, on the host, any RayCaster.
template <class R, Space S>
concept CastsRaysFrom = (PointFinder<R> && AccessibleFrom<R, S>) ||
                        (RayCaster<R> && !PointFinder<R> && S == Space::host);

/// Writes what a ray sees first to `point`; false when it leaves the scene.
template <PointFinder R>
[[nodiscard]] MIR_HD bool find_point(const R& caster, const Ray& ray, SurfacePoint& point) {
    return caster.find_point(ray, point);
}
/// The same by a caster that only the host asks. Code for both may name it; kernels never call it
/// (CastsRaysFrom).
#if defined(__CUDACC__)
#pragma nv_exec_check_disable
#endif
template <RayCaster R>
    requires(!PointFinder<R>)
[[nodiscard]] MIR_HD bool find_point(const R& caster, const Ray& ray, SurfacePoint& point) {
    const auto found = caster.closest_hit(ray);
    if (found) point = *found;
    return found.has_value();
}

/// find_point() of what lies within `reach` metres. Beyond, it may write something or nothing.
#if defined(__CUDACC__)
#pragma nv_exec_check_disable
#endif
template <class R>
[[nodiscard]] MIR_HD bool find_point_within(const R& caster, const Ray& ray, float reach,
                                            SurfacePoint& point) {
    if constexpr (ShortPointFinder<R>) {
        return caster.find_point(ray, point, reach);
    } else if constexpr (ShortRayCaster<R>) {
        const auto found = caster.closest_hit(ray, reach);
        if (found) point = *found;
        return found.has_value();
    } else {
        return find_point(caster, ray, point);
    }
}

}  // namespace mir
