// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/scene/camera.hpp"
#include "mir/scene/world_geometry.hpp"

#include <cmath>

namespace mir {

/// Camera that sees the whole box from outside, when a file brings none. It stands a little to the
/// right and above. `aspect` = width / height of the image to be made. An empty box is framed like
/// a unit cube at the origin. Depends on its arguments alone.
/// @throws Error(invalid_argument) when `aspect` is not a positive number.
inline Camera frame_bounds(const Bounds& bounds, float aspect = 1.0f) {
    expects(std::isfinite(aspect) && aspect > 0.0f,
            "frame_bounds: the aspect ratio is not a positive number; pass width / height");
    const float vertical_fov = 0.7f;
    const Vec3 centre = bounds.empty() ? Vec3(0.0f) : bounds.centre();
    const float diagonal = bounds.empty() ? 1.0f : bounds.diagonal();
    const float radius = diagonal > 0.0f ? 0.5f * diagonal : 1.0f;
    // The sphere around the box touches the edges of the narrower side of the image.
    const float narrow = std::tan(0.5f * vertical_fov) * smaller(aspect, 1.0f);
    const float distance = 1.02f * radius / std::sin(std::atan(narrow));
    const Vec3 towards_viewer = glm::normalize(Vec3(0.5f, 0.4f, 1.0f));
    // Not Camera::look_at: the direction must not depend on the rounded position of a box that is
    // far from the origin.
    Camera camera;
    camera.position = centre + distance * towards_viewer;
    camera.back = towards_viewer;
    camera.right = glm::normalize(glm::cross(Vec3(0, 1, 0), camera.back));
    camera.up = glm::cross(camera.back, camera.right);
    camera.vertical_fov = vertical_fov;
    camera.name = "framed";
    camera.focus_distance = distance;
    return camera;
}

}  // namespace mir
