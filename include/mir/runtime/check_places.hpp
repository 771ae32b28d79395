// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/scene/bounds.hpp"
#include "mir/scene/scene.hpp"

#include <cstdio>
#include <string>

namespace mir {

/// Largest coordinate that a ray may start at, metres: Embree takes none above 2^60.
inline constexpr float largest_place = 1e18f;

namespace detail {

/// @throws Error(invalid_input) that says what lies too far away.
inline void check_place(const std::string& what, Vec3 place) {
    const float reach = max_abs(place);
    if (reach <= largest_place) return;
    char distance[32];
    std::snprintf(distance, sizeof distance, "%.3g m", static_cast<double>(reach));
    throw Error(ErrorCode::invalid_input, what + " lies " + distance +
                                              " from the middle of the scene (rays start within "
                                              "1e+18 m); bring it nearer, or leave it out");
}

}  // namespace detail

/// Checks that rays can start at everything in a scene, whose triangles have these bounds, and at
/// the camera of this index.
/// @throws Error(invalid_input) that names what lies more than largest_place away.
inline void check_places(const Scene& scene, std::uint32_t camera, const Bounds& bounds) {
    if (!bounds.empty()) {
        detail::check_place("a mesh", bounds.low);
        detail::check_place("a mesh", bounds.high);
    }
    for (const PointLight& l : scene.point_lights)
        detail::check_place("light '" + l.name + "'", l.position);
    for (const SpotLight& l : scene.spot_lights)
        detail::check_place("light '" + l.name + "'", l.position);
    const Camera& c = scene.cameras[camera];
    detail::check_place("camera '" + c.name + "'", c.position);
}

}  // namespace mir
