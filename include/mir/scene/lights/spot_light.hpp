// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/light_source.hpp"
#include "mir/core/frame.hpp"
#include "mir/core/warp.hpp"
#include "mir/scene/bounds.hpp"
#include "mir/scene/lights/bounding_sphere.hpp"
#include "mir/scene/lights/light_bounds.hpp"

#include <cmath>
#include <optional>
#include <string>

namespace mir {

/// Shines into a cone around the unit vector `direction`. It has the full `intensity` (W sr^-1)
/// inside the inner angle, none outside the outer one, smooth between as glTF's KHR_lights_punctual
/// says.
struct SpotLight {
    static constexpr const char* kind = "spot light";  ///< what messages call it

    std::string name;               ///< for messages and files
    Vec3 position{0};               ///< metres
    Vec3 direction{0, 0, -1};       ///< unit, along which it shines
    Rgb intensity;                  ///< inside the inner angle; finite, not negative, W sr^-1
    float cos_inner = 1.0f;         ///< of the inner angle, counted from `direction`
    float cos_outer = 0.70710678f;  ///< of the outer angle; at most cos_inner
    std::uint16_t light_group = 0;  ///< group that its light is counted in

    /// Where it lies, metres.
    [[nodiscard]] std::optional<Bounds> bounds() const { return Bounds{position, position}; }
    /// Calls f(values...) with all that its light depends on.
    template <class F>
    void with_values(const F& f) const {
        f(position, direction, intensity, cos_inner, cos_outer, light_group);
    }
};

/// A SpotLight in the form that is sampled. Model of LightSource.
struct SpotSource {
    /// How rays find it, see LightSource.
    static constexpr LightOrigin origin = LightOrigin::place;
    /// Whether a point or a direction is drawn, see LightSource.
    static constexpr bool has_extent = false;

    Vec3 position{0};               ///< metres
    Vec3 direction{0, 0, -1};       ///< unit, along which it shines
    Rgb intensity;                  ///< inside the inner angle, W sr^-1
    float cos_inner = 1.0f;         ///< of the inner angle
    float cos_outer = 1.0f;         ///< of the outer angle
    std::uint16_t light_group = 0;  ///< group that its light is counted in

    /// A point of it for a receiver, see LightSource.
    [[nodiscard]] MIR_HD LightPoint sample(Vec2 u, Vec3 /*from*/) const { return start(u, 0.0f); }
    /// A point of it where a light path begins, see LightSource.
    [[nodiscard]] MIR_HD LightPoint start(Vec2 /*u*/, float /*side*/) const {
        LightPoint p;
        p.position = position;
        p.normal = direction;
        p.emission = intensity;
        p.light_group = light_group;
        return p;
    }
    /// A ray that leaves it, see LightSource.
    [[nodiscard]] MIR_HD Ray ray(Vec3 from, Vec3 normal, Vec2 u) const {
        return {from, Frame::around(normal).to_world(square_to_cone(u, cos_outer))};
    }
    /// Density of ray() at a surface, m^-2, see LightSource.
    [[nodiscard]] MIR_HD double ray_density(Vec3 normal, Vec3 w, float cosine, float d2) const {
        return glm::dot(w, normal) > cos_outer ? per_receiver_area(cone_pdf(cos_outer), cosine, d2)
                                               : 0.0;
    }
    /// Share of the intensity sent along `w`, 0..1. Source: KHR_lights_punctual, "Inner and outer
    /// cone angles".
    [[nodiscard]] MIR_HD float share(Vec3 normal, Vec3 w) const {
        const float width = larger(cos_inner - cos_outer, 1e-4f);
        const float t = (glm::dot(w, normal) - cos_outer) / width;
        const float clamped = smaller(larger(t, 0.0f), 1.0f);
        return clamped * clamped;
    }
    /// Power of a light path, W, see LightSource.
    [[nodiscard]] MIR_HD Rgb flux(const LightPoint& p, Vec3 w, float probability) const {
        return p.emission * (share(p.normal, w) / (cone_pdf(cos_outer) * probability));
    }
    /// Luminance of its power, W. The smooth ring integrates to a third.
    [[nodiscard]] double power() const {
        return luminance(intensity) *
               (2.0f * pi * ((1.0f - cos_inner) + (cos_inner - cos_outer) / 3.0f));
    }
    /// What a LightTree knows of it: its normals are the directions of full intensity.
    [[nodiscard]] LightBounds light_bounds() const {
        const float inner = std::acos(cos_inner);
        return {{position, position}, {direction, inner, std::acos(cos_outer) - inner}, power()};
    }
};

/// The light in the form that is sampled.
inline SpotSource source_of(const SpotLight& l, const BoundingSphere& /*scene*/) {
    return {l.position, l.direction, l.intensity, l.cos_inner, l.cos_outer, l.light_group};
}

}  // namespace mir
