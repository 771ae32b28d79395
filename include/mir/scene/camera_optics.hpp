// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/warp.hpp"

namespace mir {

/// What kernels need of a Camera to make its rays; Camera::optics() makes it. Rays have the same
/// bits on host and device: the tangent in them was computed before, and the lens is sampled by
/// unit_circle().
struct CameraOptics {
    Vec3 position{0};             ///< of the pinhole, or the middle of the lens; metres
    Vec3 right{1, 0, 0};          ///< unit
    Vec3 up{0, 1, 0};             ///< unit
    Vec3 back{0, 0, 1};           ///< unit, against the viewing direction
    float half_height = 1.0f;     ///< tangent of half the vertical field of view
    float lens_radius = 0.0f;     ///< metres; 0: pinhole
    float focus_distance = 1.0f;  ///< metres along the viewing direction; used with a lens

    /// Ray through `film` in [0,1]^2 (origin top left) from a point of the lens. `aspect` = width /
    /// height of the image; `lens` in [0,1)^2 picks the point.
    [[nodiscard]] MIR_HD Ray ray(Vec2 film, float aspect, Vec2 lens) const {
        const Vec3 through = (2.0f * film.x - 1.0f) * half_height * aspect * right +
                             (1.0f - 2.0f * film.y) * half_height * up - back;
        if (lens_radius <= 0.0f) return {position, glm::normalize(through)};
        const Vec2 disc = lens_radius * square_to_disc(lens);
        const Vec3 on_lens = position + disc.x * right + disc.y * up;
        const Vec3 in_focus = position + focus_distance * through;
        return {on_lens, glm::normalize(in_focus - on_lens)};
    }
};

}  // namespace mir
