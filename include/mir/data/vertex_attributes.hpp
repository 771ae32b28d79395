// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/rgb.hpp"

namespace mir {

/// What vertices say about a point of their triangle besides its place.
struct VertexAttributes {
    Vec2 texture_coordinates{0};  ///< (0, 0) where the mesh has none
    Rgb color{1.0f, 1.0f, 1.0f};  ///< linear, 0..1; white where the mesh has none
};

/// Those that a surface point was given.
[[nodiscard]] MIR_HD inline VertexAttributes attributes_of(const SurfacePoint& p) {
    return {p.texture_coordinates, p.color};
}

}  // namespace mir
