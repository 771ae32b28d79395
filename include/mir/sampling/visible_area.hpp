// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/scene/camera.hpp"

#include <algorithm>
#include <limits>

namespace mir {

/// Area of the surfaces that a camera sees, m^2, from a fixed grid of 64 x 64 rays: the footprint
/// of each ray is its solid angle times d^2 / cos, the cosine kept above 0.1 so that a few grazing
/// rays do not decide. 0 when nothing is seen. Deterministic.
template <RayCaster R>
double visible_area(const Camera& camera, float aspect, const R& caster) {
    constexpr std::uint32_t side = 64;
    const double half = std::tan(0.5 * static_cast<double>(camera.vertical_fov));
    const double cell = 4.0 * half * half * static_cast<double>(aspect) / (side * side);
    double area = 0.0;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const Vec2 film((static_cast<float>(x) + 0.5f) / side,
                            (static_cast<float>(y) + 0.5f) / side);
            const Ray ray = camera.ray(film, aspect, {0.5f, 0.5f});
            const auto point = caster.closest_hit(ray);
            if (!point) continue;
            const double axis = -static_cast<double>(glm::dot(ray.direction, camera.back));
            const double d2 = length_squared(point->position - ray.origin);
            const double cosine =
                -static_cast<double>(glm::dot(ray.direction, point->geometric_normal));
            area += cell * axis * axis * axis * d2 / std::max(cosine, 0.1);
        }
    return area;
}

/// The scale-free default bound of the geometry term, m^-2: that of a VPL at the radius r0 at which
/// `vpls` discs cover the visible area, 1 / (pi r0^2) = vpls / area (docs/method.md, 4.3).
inline float default_bound(double visible_area, std::uint32_t vpls) {
    if (!(visible_area > 0.0)) return std::numeric_limits<float>::max();
    return static_cast<float>(static_cast<double>(vpls) / visible_area);
}

}  // namespace mir
