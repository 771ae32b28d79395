// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <cstdint>
#include <string>

namespace mir {

/// Shines equally in all directions. `intensity` in W sr^-1.
struct PointLight {
    std::string name;
    Vec3 position{0};
    Rgb intensity;
    std::uint16_t light_group = 0;
};

/// Shines into a cone around the unit vector `direction`: full `intensity` (W sr^-1) inside the
/// inner angle, none outside the outer one, smooth between as glTF's KHR_lights_punctual says.
struct SpotLight {
    std::string name;
    Vec3 position{0};
    Vec3 direction{0, 0, -1};
    Rgb intensity;
    float cos_inner = 1.0f;
    float cos_outer = 0.70710678f;
    std::uint16_t light_group = 0;
};

/// Parallel light that travels along the unit vector `direction`. `irradiance` on a surface
/// facing it, W m^-2.
struct DirectionalLight {
    std::string name;
    Vec3 direction{0, -1, 0};
    Rgb irradiance;
    std::uint16_t light_group = 0;
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
