// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/material.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"

namespace mir {

/// A scene material in the parameters of a Bsdf. Overloaded per model by a tag of its type.
inline Lambert::Params material_params(const Material& m, Lambert) {
    return {m.base_color * ((1.0f - m.transmission) * (1.0f - m.diffuse_transmission))};
}
/// The same for one point of a textured material. A Bsdf without such an overload sees no textures.
MIR_HD inline Lambert::Params material_params(const MaterialFactors& m, Lambert) {
    return {m.base_color * ((1.0f - m.transmission) * (1.0f - m.diffuse_transmission))};
}

/// Metallic-roughness parameters (glTF 2.0, appendix B). With `metallic`, f0 runs from
/// ((ior-1)/(ior+1))^2 specular to the base colour, and f90 from specular to 1; alpha is roughness
/// squared.
MIR_HD inline CookTorrance::Params material_params(const MaterialFactors& m, CookTorrance) {
    const float r = (m.ior - 1.0f) / (m.ior + 1.0f);
    const float dielectric = r * r * m.specular;
    const auto mix = [&](float base) { return dielectric + (base - dielectric) * m.metallic; };
    CookTorrance::Params p;
    p.f0 = {mix(m.base_color.r), mix(m.base_color.g), mix(m.base_color.b)};
    p.f90 = m.specular + (1.0f - m.specular) * m.metallic;
    p.alpha = larger(m.roughness * m.roughness, min_ggx_alpha);
    p.clearcoat = m.transmission > 0.0f ? 0.0f : m.clearcoat;
    // Cosine-weighted mean of Schlick's term: F_avg = f0 + (f90 - f0) / 21. What interface and coat
    // throw back inside reaches the base again.
    const auto base = [&](float color, float f0) {
        const float mean = f0 + (p.f90 - f0) / 21.0f;
        const float below = 1.0f - mean - Clearcoat{p.clearcoat}.mean_taken(f0, p.f90);
        const float diffuse =
            color * (1.0f - m.metallic) * (1.0f - m.transmission) * (1.0f - m.diffuse_transmission);
        return below > 0.0f ? diffuse / below : 0.0f;
    };
    p.diffuse = {base(m.base_color.r, p.f0.r), base(m.base_color.g, p.f0.g),
                 base(m.base_color.b, p.f0.b)};
    return p;
}
/// Of a material without its textures.
inline CookTorrance::Params material_params(const Material& m, CookTorrance model) {
    return material_params(m.factors(), model);
}

}  // namespace mir
