// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/bounds.hpp"
#include "mir/scene/lights/outside_source.hpp"

#include <optional>
#include <string>

namespace mir {

/// Parallel light that travels along the unit vector `direction`. `irradiance` on a surface
/// facing it, W m^-2.
struct DirectionalLight {
    static constexpr const char* kind = "directional light";  ///< what messages call it

    std::string name;               ///< for messages and files
    Vec3 direction{0, -1, 0};       ///< unit, along which it shines
    Rgb irradiance;                 ///< finite, not negative, W m^-2
    std::uint16_t light_group = 0;  ///< group that its light is counted in

    /// None: it comes from outside.
    [[nodiscard]] static std::optional<Bounds> bounds() { return std::nullopt; }
    /// Calls f(values...) with all that its light depends on.
    template <class F>
    void with_values(const F& f) const {
        f(direction, irradiance, light_group);
    }
};

/// A DirectionalLight in the form that is sampled. Model of LightSource.
struct DirectionalSource : OutsideSource {
    /// Whether a point or a direction is drawn, see LightSource.
    static constexpr bool has_extent = false;

    Vec3 direction{0, -1, 0};       ///< unit, along which it shines
    Rgb irradiance;                 ///< W m^-2
    std::uint16_t light_group = 0;  ///< group that its light is counted in

    /// A point of it for a receiver, see LightSource.
    [[nodiscard]] MIR_HD LightPoint sample(Vec2 u, Vec3 /*from*/) const { return start(u, 0.0f); }
    /// A point of it where a light path begins, see LightSource.
    [[nodiscard]] MIR_HD LightPoint start(Vec2 /*u*/, float /*side*/) const {
        LightPoint p;
        p.normal = direction;
        p.emission = irradiance;
        p.light_group = light_group;
        return p;
    }
    /// Luminance of the power that enters the scene, W.
    [[nodiscard]] double power() const {
        return luminance(irradiance) * pi * scene.radius * scene.radius;
    }
};

/// The light in the form that is sampled.
inline DirectionalSource source_of(const DirectionalLight& l, const BoundingSphere& scene) {
    return {{scene}, l.direction, l.irradiance, l.light_group};
}

}  // namespace mir
