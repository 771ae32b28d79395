// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"

#include <optional>

namespace mirtest {

/// The inside of a sphere around the origin, exact where a mesh is not: for any two of its points
/// cos cos / d^2 = 1 / (4 R^2), so every point lights every other alike. The half with y > 0 has
/// material `upper`, the other material `lower`. Model of mir::RayCaster for rays that start
/// inside.
struct AnalyticSphere {
    float radius = 1.0f;
    std::uint32_t upper = 0;
    std::uint32_t lower = 0;

    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(const mir::Ray& ray) const {
        const auto ox = static_cast<double>(ray.origin.x);
        const auto oy = static_cast<double>(ray.origin.y);
        const auto oz = static_cast<double>(ray.origin.z);
        const auto dx = static_cast<double>(ray.direction.x);
        const auto dy = static_cast<double>(ray.direction.y);
        const auto dz = static_cast<double>(ray.direction.z);
        const auto r = static_cast<double>(radius);
        const double dd = dx * dx + dy * dy + dz * dz;
        const double b = (ox * dx + oy * dy + oz * dz) / dd;
        const double discriminant = b * b - (ox * ox + oy * oy + oz * oz - r * r) / dd;
        if (!(discriminant >= 0.0)) return std::nullopt;
        const double t = -b + std::sqrt(discriminant);
        if (!(t > 0.0)) return std::nullopt;
        return point(mir::Vec3(ox + t * dx, oy + t * dy, oz + t * dz));
    }

    /// Surface point in the direction of `place`, seen from inside.
    [[nodiscard]] mir::SurfacePoint point(mir::Vec3 place) const {
        mir::SurfacePoint p;
        const mir::Vec3 outward = glm::normalize(place);
        p.position = radius * outward;
        p.offset = 0x1p-16f * radius;
        p.geometric_normal = p.shading_normal = -outward;
        p.material = place.y > 0.0f ? upper : lower;
        // No triangle exists: the coordinates alone tell points apart.
        p.barycentrics = {outward.x, outward.z};
        return p;
    }
};

}  // namespace mirtest
