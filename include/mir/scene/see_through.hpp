// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/scene/material_factors.hpp"

namespace mir {

/// Smallest GGX width that a lobe is evaluated with. Below it a cosine in single precision loses
/// the shape of the lobe (here D is off by 0.7 % at worst, at 1e-3 by 12 %). A narrower lobe is a
/// perfect mirror or clear glass.
inline constexpr float min_ggx_alpha = 4e-3f;

/// True when the lobe of a roughness (0..1) is too narrow to be evaluated: light is mirrored, or
/// goes through, in one direction.
[[nodiscard]] MIR_HD inline bool is_smooth(float roughness) {
    return roughness * roughness < min_ggx_alpha;
}

/// Reflectance of a smooth dielectric interface, 0..1, by Fresnel's equations. `eta` is the index
/// behind the interface over that in front of it, `cosine` in [0, 1] that of the angle of
/// incidence. 1 where all light is reflected.
[[nodiscard]] MIR_HD inline float dielectric_reflectance(float eta, float cosine) {
    if (eta == 1.0f) return 0.0f;
    const float sin2 = (1.0f - cosine * cosine) / (eta * eta);
    if (sin2 >= 1.0f) return 1.0f;
    const float cos_t = sqrtf(1.0f - sin2);
    const float across = (cosine - eta * cos_t) / (cosine + eta * cos_t);
    const float along = (eta * cosine - cos_t) / (eta * cosine + cos_t);
    return smaller(0.5f * (across * across + along * along), 1.0f);
}

/// Share of light that passes a surface straight on, 0..1 per channel. Of a covered share `alpha`
/// a smooth sheet lets through what its interface does not reflect, tinted by its base colour; of
/// the rest all passes. `cosine` is that of the angle to the normal, not negative. The same from
/// both sides. Sources: glTF 2.0, 3.9.4 (BLEND), and KHR_materials_transmission.
[[nodiscard]] MIR_HD inline Rgb straight_transmittance(const MaterialFactors& m, float alpha,
                                                       float cosine) {
    const float open = 1.0f - alpha;
    float through = 0.0f;
    if (m.is_thin && m.transmission > 0.0f && is_smooth(m.roughness))
        through = alpha * (1.0f - m.metallic) * m.transmission *
                  (1.0f - m.specular * dielectric_reflectance(m.ior, smaller(cosine, 1.0f)));
    return Rgb{open, open, open} + m.base_color * through;
}

}  // namespace mir
