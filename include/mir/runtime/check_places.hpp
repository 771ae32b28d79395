// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/number_text.hpp"
#include "mir/scene/bounds.hpp"
#include "mir/scene/light_kinds.hpp"
#include "mir/scene/scene.hpp"

#include <string>

namespace mir {

/// Largest coordinate that a scene may have, metres. Embree takes no ray beyond 1.8e18, neither its
/// origin nor its direction: twice this from one thing to another, and light from outside, which
/// starts up to four radii of the scene before what it meets, stay within.
inline constexpr float largest_place = 1e17f;

namespace detail {

/// @throws Error(invalid_input) that says what lies too far away; `around` is the distance from
///         its place that rays start at, metres.
inline void check_place(const std::string& what, Vec3 place, float around = 0.0f) {
    const float reach = max_abs(place) + around;
    if (is_finite(place) && reach <= largest_place) return;
    throw Error(ErrorCode::invalid_input, what + " lies " +
                                              number_text(static_cast<double>(reach), 3) +
                                              " m from the middle of the scene (rays start within "
                                              "1e+17 m); bring it nearer, or leave it out");
}

}  // namespace detail

/// Checks that rays can start at everything in a scene. Its triangles have these bounds; the camera
/// of this index counts with all of its lens.
/// @throws Error(invalid_input) that names what lies more than largest_place away.
inline void check_places(const Scene& scene, std::uint32_t camera, const Bounds& bounds) {
    if (!bounds.empty()) {
        detail::check_place("a mesh", bounds.low);
        detail::check_place("a mesh", bounds.high);
    }
    for_each_listed_light(scene, [](const auto& light) {
        const std::optional<Bounds> box = light.bounds();
        if (!box) return;
        detail::check_place("light " + detail::in_quotes(light.name), box->low);
        detail::check_place("light " + detail::in_quotes(light.name), box->high);
    });
    const Camera& c = scene.cameras[camera];
    detail::check_place("camera " + detail::in_quotes(c.name), c.position);
    detail::check_place("the lens of camera " + detail::in_quotes(c.name), c.position,
                        c.lens_radius);
}

}  // namespace mir
