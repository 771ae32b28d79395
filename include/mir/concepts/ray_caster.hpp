// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"

#include <concepts>
#include <optional>

namespace mir {

/// Finds what a ray sees first.
///
/// Axioms (tests/conformance/ray_caster_suite.hpp): callable from many threads at once; agrees with
/// brute force on random triangles; nothing is returned for rays that leave the scene.
template <class R>
concept RayCaster = std::copy_constructible<R> && requires(const R r, Ray ray) {
    { r.closest_hit(ray) } -> std::same_as<std::optional<SurfacePoint>>;
};

}  // namespace mir
