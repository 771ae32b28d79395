// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/camera.hpp"

#include <optional>

namespace mir {

/// Where an image with `aspect` = width / height shows a point (metres). The film position whose
/// ray from the middle of the lens meets it, the inverse of Camera::ray(). It lies in [0,1]^2,
/// origin top left, for points inside the image; none for points that are not in front of the lens
/// plane. A pure function.
[[nodiscard]] inline std::optional<Vec2> project(const Camera& camera, float aspect, Vec3 point) {
    const CameraOptics optics = camera.optics();
    const float depth = camera.depth(point);
    if (!(depth > 0.0f)) return std::nullopt;
    const Vec3 seen = (point - camera.position) / (depth * optics.half_height);
    return Vec2{0.5f + 0.5f * glm::dot(seen, camera.right) / aspect,
                0.5f - 0.5f * glm::dot(seen, camera.up)};
}

}  // namespace mir
