// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <cstdint>
#include <string>

namespace mir {

/// Shines equally in all directions. `intensity` in W sr^-1.
struct PointLight {
    std::string name;               ///< for messages and files
    Vec3 position{0};               ///< metres
    Rgb intensity;                  ///< finite, not negative, W sr^-1
    std::uint16_t light_group = 0;  ///< group that its light is counted in
};

/// Shines into a cone around the unit vector `direction`: full `intensity` (W sr^-1) inside the
/// inner angle, none outside the outer one, smooth between as glTF's KHR_lights_punctual says.
struct SpotLight {
    std::string name;               ///< for messages and files
    Vec3 position{0};               ///< metres
    Vec3 direction{0, 0, -1};       ///< unit, along which it shines
    Rgb intensity;                  ///< inside the inner angle; finite, not negative, W sr^-1
    float cos_inner = 1.0f;         ///< of the inner angle, counted from `direction`
    float cos_outer = 0.70710678f;  ///< of the outer angle; at most cos_inner
    std::uint16_t light_group = 0;  ///< group that its light is counted in
};

/// Parallel light that travels along the unit vector `direction`. `irradiance` on a surface
/// facing it, W m^-2.
struct DirectionalLight {
    std::string name;               ///< for messages and files
    Vec3 direction{0, -1, 0};       ///< unit, along which it shines
    Rgb irradiance;                 ///< finite, not negative, W m^-2
    std::uint16_t light_group = 0;  ///< group that its light is counted in
};

/// Share of a spot light's intensity sent along the unit vector `w`, 0..1, for a light with these
/// members. Source: KHR_lights_punctual, "Inner and outer cone angles".
template <class Spot>
MIR_HD float spot_falloff(const Spot& light, Vec3 w) {
    const float width = larger(light.cos_inner - light.cos_outer, 1e-4f);
    const float t = (glm::dot(w, light.direction) - light.cos_outer) / width;
    const float clamped = smaller(larger(t, 0.0f), 1.0f);
    return clamped * clamped;
}

}  // namespace mir
