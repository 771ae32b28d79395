// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_ray.hpp"
#include "mir/scene/world_geometry.hpp"

namespace mirtest {

/// Distance to the nearest triangle, by Cramer's rule in double precision for each; infinity.
inline double nearest_triangle(const mir::WorldGeometry& geometry, const mir::SurfelRay& ray) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
        const glm::dvec3 a(geometry.corner(t, 0));
        const glm::dmat3 m(glm::dvec3(geometry.corner(t, 1)) - a,
                           glm::dvec3(geometry.corner(t, 2)) - a, -glm::dvec3(ray.direction));
        const glm::dvec3 x = glm::inverse(m) * (glm::dvec3(ray.origin) - a);
        if (x.x >= 0.0 && x.y >= 0.0 && x.x + x.y <= 1.0 && x.z > 0.0)
            nearest = std::min(nearest, x.z);
    }
    return nearest;
}

}  // namespace mirtest
