// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/light_source.hpp"
#include "mir/core/warp.hpp"
#include "mir/scene/bounds.hpp"
#include "mir/scene/lights/bounding_sphere.hpp"
#include "mir/scene/lights/light_bounds.hpp"

#include <optional>
#include <string>

namespace mir {

/// Shines equally in all directions. `intensity` in W sr^-1.
struct PointLight {
    static constexpr const char* kind = "point light";  ///< what messages call it

    std::string name;               ///< for messages and files
    Vec3 position{0};               ///< metres
    Rgb intensity;                  ///< finite, not negative, W sr^-1
    std::uint16_t light_group = 0;  ///< group that its light is counted in

    /// Where it lies, metres.
    [[nodiscard]] std::optional<Bounds> bounds() const { return Bounds{position, position}; }
    /// Calls f(values...) with all that its light depends on.
    template <class F>
    void with_values(const F& f) const {
        f(position, intensity, light_group);
    }
};

/// A PointLight in the form that is sampled. Model of LightSource.
struct PointSource {
    /// How rays find it, see LightSource.
    static constexpr LightOrigin origin = LightOrigin::place;
    /// Whether a point or a direction is drawn, see LightSource.
    static constexpr bool has_extent = false;

    Vec3 position{0};               ///< metres
    Rgb intensity;                  ///< W sr^-1
    std::uint16_t light_group = 0;  ///< group that its light is counted in

    /// A point of it for a receiver, see LightSource.
    [[nodiscard]] MIR_HD LightPoint sample(Vec2 u, Vec3 /*from*/) const { return start(u, 0.0f); }
    /// A point of it where a light path begins, see LightSource.
    [[nodiscard]] MIR_HD LightPoint start(Vec2 /*u*/, float /*side*/) const {
        LightPoint p;
        p.position = position;
        p.emission = intensity;
        p.light_group = light_group;
        return p;
    }
    /// A ray that leaves it, see LightSource.
    [[nodiscard]] MIR_HD static Ray ray(Vec3 from, Vec3 /*normal*/, Vec2 u) {
        return {from, square_to_sphere(u)};
    }
    /// Density of ray() at a surface, m^-2, see LightSource.
    [[nodiscard]] MIR_HD static double ray_density(Vec3 /*normal*/, Vec3 /*w*/, float cosine,
                                                   float d2) {
        return per_receiver_area(sphere_pdf(), cosine, d2);
    }
    /// Factor of the emission along a direction, see LightSource.
    [[nodiscard]] MIR_HD static float share(Vec3 /*normal*/, Vec3 /*w*/) { return 1.0f; }
    /// Power of a light path, W, see LightSource.
    [[nodiscard]] MIR_HD static Rgb flux(const LightPoint& p, Vec3 /*w*/, float probability) {
        return p.emission * (1.0f / (sphere_pdf() * probability));
    }
    /// Luminance of its power, W.
    [[nodiscard]] double power() const { return luminance(intensity) * 4.0f * pi; }
    /// What a LightTree knows of it.
    [[nodiscard]] LightBounds light_bounds() const {
        return {{position, position}, LightCone::everywhere(), power()};
    }
};

/// The light in the form that is sampled.
inline PointSource source_of(const PointLight& l, const BoundingSphere& /*scene*/) {
    return {l.position, l.intensity, l.light_group};
}

}  // namespace mir
