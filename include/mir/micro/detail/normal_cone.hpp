// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/detail/disc_reach.hpp"

namespace mir::detail {

/// Cone around the normals of discs.
struct NormalCone {
    Vec3 axis{0, 0, 1};
    float cos_angle = 1.0f;
};

/// Around the mean normal by area, or the first one where normals cancel. In exact arithmetic every
/// normal is inside: the cosine is rounded downwards, past its error. Equal normals have no width.
inline NormalCone normal_cone(std::span<const Surfel> surfels) {
    if (std::all_of(surfels.begin(), surfels.end(),
                    [&](const Surfel& s) { return s.normal == surfels[0].normal; }))
        return {surfels[0].normal, 1.0f};
    Double3 sum(0.0);
    double area = 0.0;
    for (const Surfel& s : surfels) {
        sum += static_cast<double>(s.area) * Double3(s.normal);
        area += static_cast<double>(s.area);
    }
    const bool cancels = !(glm::length(sum) > 1e-6 * area);
    const Vec3 axis = cancels ? surfels[0].normal : Vec3(glm::normalize(sum));
    const Double3 unit = glm::normalize(Double3(axis));
    double least = 1.0;
    for (const Surfel& s : surfels)
        least = std::min(least, glm::dot(unit, glm::normalize(Double3(s.normal))));
    return {axis, larger(-1.0f, rounded_down(least - 0x1p-48))};
}

/// How far discs reach along an axis, to either side, metres, rounded upwards. Counted from a
/// point. `axis` need only be a unit vector as far as single precision goes.
inline float thickness_along(std::span<const Surfel> surfels, Vec3 from, Vec3 axis) {
    const Double3 unit = glm::normalize(Double3(axis));
    double most = 0.0;
    for (const Surfel& s : surfels) {
        const double tilt = glm::length(glm::cross(unit, glm::normalize(Double3(s.normal))));
        const double height = std::fabs(glm::dot(unit, Double3(s.position) - Double3(from)));
        most = std::max(most, height + tilt * static_cast<double>(s.radius));
    }
    return rounded_up(most * (1.0 + 0x1p-40));
}

}  // namespace mir::detail
