// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_ray.hpp"
#include "mir/scene/world_geometry.hpp"

namespace mirtest {

/// Distance to the nearest triangle, by Cramer's rule in double precision for each; infinity.
inline double nearest_triangle(const mir::WorldGeometry& geometry, const mir::SurfelRay& ray) {
    using Double3 = glm::dvec3;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
        const Double3 a(geometry.corner(t, 0));
        const glm::dmat3 m(Double3(geometry.corner(t, 1)) - a, Double3(geometry.corner(t, 2)) - a,
                           -Double3(ray.direction));
        const Double3 x = glm::inverse(m) * (Double3(ray.origin) - a);
        if (x.x >= 0.0 && x.y >= 0.0 && x.x + x.y <= 1.0 && x.z > 0.0)
            nearest = std::min(nearest, x.z);
    }
    return nearest;
}

}  // namespace mirtest
