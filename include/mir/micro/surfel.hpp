// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>

namespace mir {

/// A disc that stands for a piece of a triangle: around the centroid of the piece, in the plane of
/// the triangle. A trivially copyable value.
struct Surfel {
    Vec3 position{0};            ///< centre, metres
    float radius = 0.0f;         ///< metres; SurfelOptions::extent says which
    Vec3 normal{0, 0, 1};        ///< unit, of the triangle's front
    float area = 0.0f;           ///< of the piece, m^2
    std::uint32_t triangle = 0;  ///< index into WorldGeometry
    std::uint32_t material = 0;  ///< index into Scene::materials
};

}  // namespace mir
