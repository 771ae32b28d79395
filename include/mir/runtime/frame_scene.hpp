// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/scene/framing.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace mir {

/// A view of a scene that has no camera of its own.
struct FramedScene {
    Camera camera;        ///< level, +y up
    bool inside = false;  ///< it stands in the scene, a room; else the whole scene is before it
};

namespace detail {

/// Looks for a place inside of a scene from which much of it is seen. `R` casts rays at it.
template <RayCaster R>
class RoomView {
 public:
    RoomView(const R& caster, const Bounds& bounds, float aspect)
        : caster_(caster), bounds_(bounds), aspect_(aspect) {}

    /// True when fronts of surfaces surround most places. From the places of a grid they are seen
    /// in six of ten directions, in the mean. Walls of a room show them, a solid thing shows backs.
    [[nodiscard]] bool is_room() const {
        double seen = 0.0;
        const std::vector<Vec3> places = eyes();
        for (const Vec3 eye : places) seen += share_of_fronts(eye);
        return seen > 0.6 * static_cast<double>(places.size());
    }

    /// The camera of the grid that sees farthest, in the mean of logarithms.
    [[nodiscard]] Camera best() const {
        Camera best;
        double most = -1.0;
        for (const Vec3 eye : eyes()) {
            if (share_of_fronts(eye) < 0.5) continue;
            for (int turn = 0; turn < 8; ++turn) {
                const float angle = 0.25f * pi * static_cast<float>(turn);
                const Camera camera = Camera::look_at(
                    eye, eye + Vec3(std::sin(angle), -0.08f, std::cos(angle)), {0, 1, 0}, fov);
                const double score = depth_of(camera);
                if (score > most) {
                    most = score;
                    best = camera;
                }
            }
        }
        best.name = "framed inside";
        return best;
    }

 private:
    static constexpr float fov = 1.05f;
    static constexpr int directions = 128;

    [[nodiscard]] std::vector<Vec3> eyes() const {
        std::vector<Vec3> all;
        const Vec3 size = bounds_.high - bounds_.low;
        for (const float y : {0.4f, 0.55f})
            for (const float z : {0.06f, 0.28f, 0.5f, 0.72f, 0.94f})
                for (const float x : {0.06f, 0.28f, 0.5f, 0.72f, 0.94f})
                    all.push_back(bounds_.low + size * Vec3(x, y, z));
        return all;
    }
    /// Of all directions, evenly spread (the points of a Fibonacci lattice).
    [[nodiscard]] double share_of_fronts(Vec3 eye) const {
        int fronts = 0;
        for (int i = 0; i < directions; ++i) {
            const float y = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / directions;
            const float turn = 2.3999632f * static_cast<float>(i);
            const float r = std::sqrt(1.0f - y * y);
            const auto met =
                caster_.closest_hit({eye, {r * std::cos(turn), y, r * std::sin(turn)}});
            fronts += met && met->front ? 1 : 0;
        }
        return static_cast<double>(fronts) / directions;
    }
    /// Surfaces that turn away, and what lies outside, count as near.
    [[nodiscard]] double depth_of(const Camera& camera) const {
        const float unit = 0.05f * bounds_.diagonal();
        double sum = 0.0;
        for (int j = 0; j < 9; ++j)
            for (int i = 0; i < 12; ++i) {
                const Vec2 film((static_cast<float>(i) + 0.5f) / 12.0f,
                                (static_cast<float>(j) + 0.5f) / 9.0f);
                const auto met = caster_.closest_hit(camera.ray(film, aspect_, {0.5f, 0.5f}));
                if (met && met->front)
                    sum += std::log1p(glm::length(met->position - camera.position) / unit);
            }
        return sum;
    }

    R caster_;
    Bounds bounds_;
    float aspect_;
};

}  // namespace detail

/// A view of a scene without a camera. It looks from inside where the scene is a room, else at the
/// whole from outside (frame_bounds()). `aspect` = width / height of the image to be made. Builds a
/// kd-tree on the calling thread. Depends on its arguments alone.
/// @throws Error(invalid_argument) when `aspect` is not a positive number; what WorldGeometry
///         throws.
inline FramedScene frame_scene(const Scene& scene, float aspect = 1.0f, const Limits& limits = {}) {
    const WorldGeometry geometry(scene, limits);
    const Camera outside = frame_bounds(geometry.bounds(), aspect);
    if (geometry.triangles().empty()) return {outside, false};
    const KdTreeScene traced(geometry);
    const detail::RoomView view(traced.ray_caster(), geometry.bounds(), aspect);
    return view.is_room() ? FramedScene{view.best(), true} : FramedScene{outside, false};
}

}  // namespace mir
