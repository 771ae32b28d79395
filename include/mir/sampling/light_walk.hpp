// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/light_path.hpp"
#include "mir/sampling/path_numbers.hpp"
#include "mir/shading/specular_tracer.hpp"

#include <optional>

namespace mir {

/// A vertex of a light path, where a VPL may lie.
template <Bsdf B>
struct LightVertex {
    Arrival<B> at;            ///< what arrives there
    typename B::Params bsdf;  ///< of the surface
    Vec3 normal{0};           ///< unit, around which it scatters
    bool is_straight = true;  ///< no mirror and no body of glass lies on the last edge
};

/// Goes from light to surface and from surface to surface, through specular chains. A value of
/// views; const use from any thread.
template <Bsdf B, RayCaster R>
struct LightWalk {
    SurfaceTableView<Space::host, B> surfaces;  ///< materials
    R caster;                                   ///< what rays meet

    /// The vertex that `light` reaches. None where it leaves the scene or nothing is left of it.
    /// Numbers are drawn only at specular surfaces.
    [[nodiscard]] std::optional<LightVertex<B>> next(const Emission& light,
                                                     PathNumbers& numbers) const {
        const auto point = caster.closest_hit(light.ray);
        if (!point || is_black(light.power)) return std::nullopt;
        SpecularEnd met;
        met.ray = light.ray;
        met.point = *point;
        met.is_background = false;
        SpecularTracer{caster, surfaces}.follow(met, Transport::power, numbers);
        if (met.is_background || is_black(met.reflection)) return std::nullopt;
        LightVertex<B> v{{met.point, -met.ray.direction, light.power * met.reflection},
                         params_at(met),
                         met.point.geometric_normal,
                         met.is_straight};
        if (!met.on_coat) v.at.point.shading_normal = surfaces.shading_normal(met.point);
        // What reflects alike in all directions does so below its shading normal, too.
        if (!surfaces.is_lambertian(met.point.material)) v.normal = v.at.point.shading_normal;
        return v;
    }

 private:
    [[nodiscard]] typename B::Params params_at(const SpecularEnd& met) const {
        const SurfacePoint& p = met.point;
        if (met.on_coat) return surfaces.coat(p.material);
        return surfaces.params_of_side(surfaces.params(p.material, attributes_of(p)), p.material,
                                       p.front);
    }
};

/// Ends a light path by chance where a surface absorbed much, or makes up for that it might have.
/// `roulette` is in [0, 1); `weight` is that of the sample that `light` left by.
[[nodiscard]] inline bool survives_roulette(Emission& light, Rgb weight, float roulette) {
    const float odds = smaller(max_channel(weight), 1.0f);
    if (!(roulette < odds)) return false;
    light.power = light.power * (1.0f / odds);
    return true;
}

}  // namespace mir
