// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/warp.hpp"

#include <string>

namespace mir {

/// Perspective camera: a pinhole, or a thin lens when `lens_radius` is positive. Looks along -z of
/// its own frame, +y up (glTF). Value type; const use from any thread.
struct Camera {
    std::string name;
    Vec3 position{0};
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

    /// Ray through `film` in [0,1]^2 (origin top left) of an image with `aspect` = width / height,
    /// from the point of the lens that `lens` in [0,1)^2 picks.
    [[nodiscard]] Ray ray(Vec2 film, float aspect, Vec2 lens) const {
        const float half = std::tan(0.5f * vertical_fov);
        const Vec3 through = (2.0f * film.x - 1.0f) * half * aspect * right +
                             (1.0f - 2.0f * film.y) * half * up - back;
        if (lens_radius <= 0.0f) return {position, glm::normalize(through)};
        const Vec2 disc = lens_radius * square_to_disc(lens);
        const Vec3 on_lens = position + disc.x * right + disc.y * up;
        const Vec3 in_focus = position + focus_distance * through;
        return {on_lens, glm::normalize(in_focus - on_lens)};
    }

    /// Depth of a point: its distance from the lens plane, metres.
    [[nodiscard]] float depth(Vec3 point) const { return glm::dot(position - point, back); }
};

}  // namespace mir
