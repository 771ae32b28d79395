// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/accept_box.hpp"
#include "mir/core/double3.hpp"
#include "mir/micro/surfel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace mir::detail {

/// Distance from a point to the farthest point of a disc, metres. Relative error below 2^-48. The
/// part of the way that lies in the plane comes from a cross product: a difference of squares would
/// lose it where the point lies above the centre.
inline double farthest_distance(const Surfel& s, Double3 from) {
    const Double3 n(s.normal);
    const Double3 d = Double3(s.position) - from;
    const double n2 = glm::dot(n, n);
    const Double3 across = glm::cross(d, n);
    const double height2 = glm::dot(d, n) * glm::dot(d, n) / n2;
    const double reach = std::sqrt(glm::dot(across, across) / n2) + static_cast<double>(s.radius);
    return std::sqrt(height2 + reach * reach);
}

/// The farthest point itself; any of them where there are several.
inline Double3 farthest_point(const Surfel& s, Double3 from) {
    const Double3 n = glm::normalize(Double3(s.normal));
    const Double3 d = Double3(s.position) - from;
    Double3 along = d - glm::dot(d, n) * n;
    if (!(glm::dot(along, along) > 1e-24 * glm::dot(d, d)))
        along = glm::cross(n, std::fabs(n.x) < 0.5 ? Double3(1, 0, 0) : Double3(0, 1, 0));
    return Double3(s.position) + static_cast<double>(s.radius) * glm::normalize(along);
}

/// The disc that reaches farthest away from a point, and how far.
struct FarthestDisc {
    std::size_t index = 0;
    double distance = 0.0;  ///< metres
};

inline FarthestDisc farthest_disc(std::span<const Surfel> surfels, Double3 from) {
    FarthestDisc found;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const double distance = farthest_distance(surfels[i], from);
        if (distance > found.distance) found = {i, distance};
    }
    return found;
}

}  // namespace mir::detail
