// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>
#include <limits>

namespace mir {

/// A ray that gathers light over a solid angle.
struct SurfelRay {
    Vec3 origin{0};            ///< metres; lifted where it lies on a surface
    Vec3 direction{0, 0, -1};  ///< unit
    /// Unit normal of the surface that gathers, on its lit side. What lies below the tangent plane
    /// through the origin is not met: the surface's own discs, which lie in that plane (a lifted
    /// origin is above it), and of whole discs (Surfel::is_whole) all that have their centre below,
    /// whose rims would stick out. Nodes whose centre lies below are never met as a whole. Zero: no
    /// surface.
    Vec3 normal{0};
    float solid_angle = 0.0f;  ///< sr; 0: exact
};

/// What a ray met first.
struct SurfelHit {
    static constexpr std::uint32_t none = 0xFFFFFFFFu;  ///< node of a ray that met nothing

    float t = std::numeric_limits<float>::infinity();  ///< distance from the origin, metres
    std::uint32_t node = none;                         ///< a leaf, or where the ray stopped
    bool front = true;                                 ///< the side of its normals is seen
};

}  // namespace mir
