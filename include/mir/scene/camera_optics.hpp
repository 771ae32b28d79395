// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/warp.hpp"

namespace mir {

/// Where on the film a camera sees a point.
struct FilmPoint {
    Vec3 from{0};                ///< the point of the lens that sees it, metres
    Vec2 film{-1};               ///< in [0,1]^2 where it is on the film
    float per_steradian = 0.0f;  ///< share of the film that a solid angle around it takes, sr^-1

    /// True when the point lies before the camera and within its picture.
    [[nodiscard]] MIR_HD bool is_on_film() const {
        return per_steradian > 0.0f && film.x >= 0.0f && film.x < 1.0f && film.y >= 0.0f &&
               film.y < 1.0f;
    }
};

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

    /// The inverse of ray(): where it sees `point` from a point of the lens.
    [[nodiscard]] MIR_HD FilmPoint project(Vec3 point, float aspect, Vec2 lens) const {
        FilmPoint out;
        out.from = position;
        if (lens_radius > 0.0f) {
            const Vec2 disc = lens_radius * square_to_disc(lens);
            out.from = position + disc.x * right + disc.y * up;
        }
        const Vec3 d = point - out.from;
        const float depth = -glm::dot(d, back);
        if (!(depth > 0.0f)) return out;
        // Where the ray meets the plane in focus, over its distance: `through` of ray().
        const float focus = lens_radius > 0.0f ? focus_distance : 1.0f;
        const Vec3 through = (out.from - position + d * (focus / depth)) * (1.0f / focus);
        out.film = {0.5f + 0.5f * glm::dot(through, right) / (half_height * aspect),
                    0.5f - 0.5f * glm::dot(through, up) / half_height};
        const float cosine = depth / glm::length(d);
        out.per_steradian =
            1.0f / (4.0f * half_height * half_height * aspect * cosine * cosine * cosine);
        return out;
    }
};

}  // namespace mir
