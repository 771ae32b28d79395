// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"

namespace mir {

/// Finds what a ray meets that leaves `point` along `ray.direction`, on the side of the unit
/// `normal`. Writes where the ray begins, and `point`; false when it leaves the scene.
///
/// A plane is left for good, so that its own triangle is not met once more: what lets a share of
/// the light pass would take that share twice. Points by the edges of closed bodies lie before
/// their plane (leave_on_ray()), and the usual lift does not bring them across.
template <class R>
[[nodiscard]] MIR_HD bool find_next(const R& caster, Vec3 normal, Ray& ray, SurfacePoint& point) {
    constexpr std::uint32_t tries = 10;
    const std::uint32_t own = point.triangle;
    const Vec3 from = point.position;
    float lifted = larger(point.offset, least_offset(from));
    for (std::uint32_t i = 0; i < tries; ++i, lifted *= 2.0f) {
        ray.origin = lift(from, normal, lifted);
        if (!find_point(caster, ray, point)) return false;
        if (point.triangle != own) return true;
    }
    return false;
}

}  // namespace mir
