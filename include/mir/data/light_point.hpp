// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <cstdint>

namespace mir {

/// From where a light shines.
enum class LightOrigin : std::uint8_t {
    surface,  ///< from a surface of the scene, which rays meet: a lamp
    place,    ///< from a place in the scene that no ray meets
    outside   ///< from outside the scene: it has a direction, but no place
};

/// A point of a light, or one direction of light from outside. What a sample of a light is.
struct LightPoint {
    Vec3 position{0};        ///< metres, lifted off a surface; from outside none
    Vec3 normal{0, 0, 1};    ///< unit, of the side that shines, or axis of a place; from outside
                             ///< the direction in which the light travels
    Rgb emission;            ///< radiance, W m^-2 sr^-1; of a point without extent intensity,
                             ///< W sr^-1, of a direction without extent irradiance, W m^-2
    float pdf = 1.0f;        ///< of this choice: per m^2, from outside per sr; 1 where there
                             ///< is none
    std::uint8_t sides = 1;  ///< that shine there: 1 or 2; one was chosen
    std::uint16_t light_group = 0;  ///< of the light
    std::uint32_t triangle = 0;     ///< of a surface: index into WorldGeometry::triangles()
    Vec2 barycentrics{0};           ///< of a surface: weights of the second and third vertex

    /// Density of this choice as the start of a light path, which takes any side.
    [[nodiscard]] MIR_HD float pdf_start() const { return pdf / static_cast<float>(sides); }
};

/// Density per m^2 of a receiver for a direction drawn with density `pdf`. The receiver has cosine
/// `cosine` at the squared distance `d2`; `pdf` is per steradian.
MIR_HD inline double per_receiver_area(float pdf, float cosine, float d2) {
    return static_cast<double>(cosine) / static_cast<double>(d2) * static_cast<double>(pdf);
}

}  // namespace mir
