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
/// normal is inside: the cosine is rounded downwards, past its error.
inline NormalCone normal_cone(std::span<const Surfel> surfels) {
    if (surfels.size() == 1) return {surfels[0].normal, 1.0f};
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

}  // namespace mir::detail
