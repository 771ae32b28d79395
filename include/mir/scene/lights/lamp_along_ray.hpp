// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/scene/crossing_number.hpp"
#include "mir/scene/light_table_view.hpp"

#include <cmath>
#include <cstdint>

namespace mir {

/// An emissive triangle that a ray meets. What else is in its way is not asked.
struct LampAlongRay {
    std::uint32_t lamp = LightPick::none;  ///< index into LampView::triangles
    float probability = 0.0f;              ///< with which LightTreeView::pick() chooses it
    Vec2 barycentrics{0};                  ///< of the place, see EmitterSample
    float distance = INFINITY;             ///< of the ray's origin, metres
    float chance = 1.0f;                   ///< of the choice among the lamps along the ray

    /// True when the ray meets a lamp.
    [[nodiscard]] MIR_HD bool is_found() const { return lamp != LightPick::none; }
};

namespace detail {

/// A walk through a LightTree along a ray from a receiver, for what lies behind a lamp.
template <Space S>
class LampSearch {
 public:
    MIR_HD LampSearch(const LightTableView<S>& lights, const GeometryView<S>& geometry,
                      const LightReceiver& at, Vec3 direction, const LampAlongRay& before)
        : lights_(lights),
          geometry_(geometry),
          at_(at),
          direction_(direction),
          before_(before.lamp),
          nearest_(before.is_found() ? before.distance : 0.0f) {}

    [[nodiscard]] MIR_HD LampAlongRay operator()() {
        Branch next{0, 1.0f};
        std::uint32_t waiting = 0;
        for (;;) {
            const LightNode& node = lights_.tree.nodes[next.node];
            const std::uint32_t found = node.is_leaf() ? 0 : descend(node, next.probability);
            if (node.is_leaf()) meet(node.rest(), next.probability);
            if (found == 2) waiting_[waiting++] = branches_[1];
            if (found > 0) {
                next = branches_[0];
            } else {
                if (waiting == 0) return found_;
                next = waiting_[--waiting];
            }
        }
    }

 private:
    struct Branch {
        std::uint32_t node = 0;
        float probability = 1.0f;  ///< of the way from the root
    };

    /// Writes those children that the ray may meet and the receiver may choose; how many.
    MIR_HD std::uint32_t descend(const LightNode& node, float probability) {
        const float chance = lights_.tree.chance_of_first(node, at_);
        if (chance < 0.0f) return 0;
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < 2; ++i) {
            const float own = i == 0 ? chance : 1.0f - chance;
            if (own > 0.0f && meets(lights_.tree.nodes[node.rest() + i]))
                branches_[count++] = {node.rest() + i, probability * own};
        }
        return count;
    }

    /// Whether the ray may meet the sphere of a node. Generous: what is near is looked at.
    [[nodiscard]] MIR_HD bool meets(const LightNode& node) const {
        const Vec3 to = node.centre - at_.position;
        const float reach = node.radius * 1.001f + 1e-5f * max_abs(to);
        const float along = glm::dot(to, direction_);
        return along > -reach && along < found_.distance + reach &&
               length_squared(glm::cross(to, direction_)) <= reach * reach;
    }

    /// Keeps a lamp if it is the nearest that shines along the ray. Source: Moeller and Trumbore,
    /// "Fast, minimum storage ray-triangle intersection", 1997.
    MIR_HD void meet(std::uint32_t lamp, float probability) {
        if (lamp >= lights_.lamps.count || lamp == before_) return;
        const std::uint32_t triangle = lights_.lamps.triangles[lamp];
        const Vec3 corner = geometry_.corner(triangle, 0);
        const Vec3 a = geometry_.corner(triangle, 1) - corner;
        const Vec3 b = geometry_.corner(triangle, 2) - corner;
        const Vec3 across = glm::cross(direction_, b);
        const float volume = glm::dot(a, across);
        // Positive where the ray meets the front.
        if (!(volume > 0.0f) && !(volume < 0.0f && lights_.lamps.lamp_triangles[lamp].both_sides))
            return;
        const Vec3 from = at_.position - corner;
        const float u = glm::dot(from, across) / volume;
        const Vec3 other = glm::cross(from, a);
        const float v = glm::dot(direction_, other) / volume;
        const float t = glm::dot(b, other) / volume;
        if (!(u >= 0.0f && v >= 0.0f && u + v <= 1.0f && t > nearest_ && t < found_.distance))
            return;
        if (is_black(lights_.lamps.radiance_at(geometry_, triangle, {u, v}))) return;
        found_ = {lamp, probability, {u, v}, t};
    }

    /// More than LightTree grows: 64 levels, and 29 of halves.
    static constexpr std::uint32_t deepest = 96;

    const LightTableView<S>& lights_;
    const GeometryView<S>& geometry_;
    const LightReceiver& at_;
    Vec3 direction_;
    std::uint32_t before_;  ///< a lamp that is not looked for
    float nearest_;         ///< what is not farther is not looked for, metres
    LampAlongRay found_;
    Branch branches_[2];
    Branch waiting_[deepest];
};

}  // namespace detail

/// A lamp that a ray from a receiver into the unit direction `w` meets. The first, or one behind a
/// lamp that is seen through: each of these is taken with half of the chance that is left, where
/// there is another. The LightTree must not be empty; lights without a surface are not met. Host
/// and device.
template <Space S>
[[nodiscard]] MIR_HD LampAlongRay lamp_along(const LightTableView<S>& lights,
                                             const GeometryView<S>& geometry,
                                             const LightReceiver& at, Vec3 w) {
    LampAlongRay found;
    for (;;) {
        LampAlongRay next = detail::LampSearch<S>(lights, geometry, at, w, found)();
        if (!next.is_found()) return found;
        if (found.is_found()) {
            found.chance *= 0.5f;
            // No segment of the picture: its own bit is another number.
            if (crossing_number(at.position, at.position + w, found.lamp) < 0.5f) return found;
        }
        next.chance = found.chance;
        found = next;
        if (!lights.lamps.is_see_through(geometry, found.lamp)) return found;
    }
}

}  // namespace mir
