// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/light_path.hpp"
#include "mir/sampling/path_numbers.hpp"
#include "mir/shading/specular_tracer.hpp"

namespace mir {

/// A vertex of a light path, where a VPL may lie.
template <Bsdf B>
struct LightVertex {
    Arrival<B> at;            ///< what arrives there
    typename B::Params bsdf;  ///< of the surface
    Vec3 normal{0};           ///< unit, around which it scatters
    bool is_straight = true;  ///< no mirror and no body of glass lies on the last edge
    bool is_through = false;  ///< the light has gone through the surface diffusely
};

/// Goes from light to surface and from surface to surface, through specular chains. A value of
/// views for host and device; const use from any thread.
template <Bsdf B, class R, Space S = Space::host>
struct LightWalk {
    SurfaceTableView<S, B> surfaces;  ///< materials
    R caster;                         ///< what rays meet

    /// Writes the vertex that `light` reaches. False where it leaves the scene or nothing is left
    /// of it. Numbers are drawn only at specular surfaces.
    [[nodiscard]] MIR_HD bool next(const Emission& light, PathNumbers& numbers,
                                   LightVertex<B>& v) const {
        if (is_black(light.power)) return false;
        SpecularEnd met;
        met.ray = light.ray;
        met.is_background = !find_point(caster, light.ray, met.point);
        if (met.is_background) return false;
        SpecularTracer{caster, surfaces}.follow(met, Transport::power, numbers);
        if (met.is_background || is_black(met.reflection)) return false;
        v = {{met.point, -met.ray.direction, light.power * met.reflection},
             params_at(met),
             met.point.geometric_normal,
             met.is_straight,
             met.is_through};
        if (!met.on_coat) v.at.point.shading_normal = surfaces.shading_normal(met.point);
        // What reflects alike in all directions does so below its shading normal, too.
        if (!surfaces.is_lambertian(met.point.material)) v.normal = v.at.point.shading_normal;
        return true;
    }

 private:
    [[nodiscard]] MIR_HD typename B::Params params_at(const SpecularEnd& met) const {
        const SurfacePoint& p = met.point;
        if (met.on_coat) return surfaces.coat(p.material, attributes_of(p));
        if (met.is_through) return surfaces.through(p.material, attributes_of(p));
        return surfaces.params_of_side(surfaces.params(p.material, attributes_of(p)), p.material,
                                       p.front);
    }
};

/// Ends a light path by chance where a surface absorbed much, or makes up for that it might have.
/// `roulette` is in [0, 1); `weight` is that of the sample that `light` left by.
[[nodiscard]] MIR_HD inline bool survives_roulette(Emission& light, Rgb weight, float roulette) {
    const float odds = smaller(max_channel(weight), 1.0f);
    if (!(roulette < odds)) return false;
    light.power = light.power * (1.0f / odds);
    return true;
}

}  // namespace mir
