// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/camera_optics.hpp"

#include <cmath>
#include <string>

namespace mir {

/// Perspective camera: a pinhole, or a thin lens when `lens_radius` is positive. Looks along -z of
/// its own frame, +y up (glTF). Value type; const use from any thread.
struct Camera {
    std::string name;             ///< for messages and files
    Vec3 position{0};             ///< of the pinhole, or the middle of the lens; metres
    Vec3 right{1, 0, 0};          ///< unit
    Vec3 up{0, 1, 0};             ///< unit
    Vec3 back{0, 0, 1};           ///< unit, against the viewing direction
    float vertical_fov = 0.8f;    ///< full angle in radians
    float aspect_ratio = 0.0f;    ///< width / height of the file; 0: not given
    float lens_radius = 0.0f;     ///< metres; 0: pinhole
    float focus_distance = 1.0f;  ///< metres along the viewing direction; used with a lens

    /// Camera at `position` that looks at `target`.
    static Camera look_at(Vec3 position, Vec3 target, Vec3 up, float vertical_fov) {
        Camera c;
        c.position = position;
        c.back = glm::normalize(position - target);
        c.right = glm::normalize(glm::cross(up, c.back));
        c.up = glm::cross(c.back, c.right);
        c.vertical_fov = vertical_fov;
        return c;
    }

    /// What kernels need to make rays.
    [[nodiscard]] CameraOptics optics() const {
        return {position,    right,         up, back, std::tan(0.5f * vertical_fov),
                lens_radius, focus_distance};
    }

    /// Ray through `film` in [0,1]^2 (origin top left), from a point of the lens. `aspect` = width
    /// / height of the image; `lens` in [0,1)^2 picks the point.
    [[nodiscard]] Ray ray(Vec2 film, float aspect, Vec2 lens) const {
        return optics().ray(film, aspect, lens);
    }

    /// Depth of a point: its distance from the lens plane, metres.
    [[nodiscard]] float depth(Vec3 point) const { return glm::dot(position - point, back); }
};

}  // namespace mir
