// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/scene/see_through.hpp"
#include "mir/shading/material_params.hpp"
#include "mir/shading/surface_table_view.hpp"

namespace mir {

/// Which way a chain carries: light towards lamps shrinks by the square of the index where it is
/// refracted, power does not.
enum class Transport : std::uint8_t {
    radiance,  ///< from the camera
    power      ///< from a light
};

/// A point of a surface where a ray may go on as a specular chain.
struct SpecularSurface {
    MaterialFactors factors;    ///< of the material there
    float cover = 1.0f;         ///< covered share, 0..1
    Vec3 normal{0};             ///< unit shading normal, on the side of `wo`
    Vec3 geometric_normal{0};   ///< unit, the same side
    Vec3 wo{0};                 ///< unit, where the ray came from
    bool front = true;          ///< `wo` lies outside of a body
    bool has_interface = true;  ///< what is opaque and smooth is a mirror
    Vec3 coat_normal{0, 0, 1};  ///< unit, that of a coat: without the surface's normal texture
    float through = 0.0f;       ///< share of the light that goes through diffusely, 0..1

    /// True for the surface of a body that light enters.
    [[nodiscard]] MIR_HD bool bounds_body() const { return !factors.is_thin && clear() > 0.0f; }
    /// Share of the light below the interface that goes through.
    [[nodiscard]] MIR_HD float clear() const {
        return (1.0f - factors.metallic) * factors.transmission;
    }
    /// Index of refraction behind the surface over that in front of it.
    [[nodiscard]] MIR_HD float eta() const {
        if (!bounds_body()) return factors.ior;
        return front ? factors.ior : 1.0f / factors.ior;
    }
    /// Reflectance of the dielectric interface at a cosine, 0..1.
    [[nodiscard]] MIR_HD float dielectric(float cosine) const {
        const float f = dielectric_reflectance(eta(), smaller(cosine, 1.0f));
        return f < 1.0f ? factors.specular * f : 1.0f;
    }
    /// Reflectance of the coat at a cosine, 0..1. Glass has none.
    [[nodiscard]] MIR_HD float coat(float cosine) const {
        if (!has_interface || factors.transmission > 0.0f) return 0.0f;
        return Clearcoat{factors.clearcoat}.reflectance(
            CookTorrance::fifth_power(1.0f - larger(cosine, 0.0f)));
    }
    /// What a mirror reflects at a cosine: the clear share by the interface's reflectance
    /// `at_glass`, the rest by the Fresnel term of CookTorrance. Its base is below that term alone:
    /// where glass reflects all, the clear share must not add to what the base sends back.
    [[nodiscard]] MIR_HD Rgb mirror(float at_glass, float cosine) const {
        const CookTorrance::Params p = material_params(factors, CookTorrance{});
        const float glass = clear() * at_glass;
        return Rgb{glass, glass, glass} +
               CookTorrance::schlick(p, larger(cosine, 0.0f)) * (1.0f - clear());
    }
};

/// The shares of light that leave a surface other than by its Bsdf. Of all that is reflected and
/// let through they leave `rest` times what specular_end_params() says.
struct SpecularShares {
    Rgb pass;              ///< goes straight on
    Rgb mirrored;          ///< reflected by an interface without a lobe of its own
    float coated = 0.0f;   ///< reflected by the coat, in one direction or by its lobe
    float through = 0.0f;  ///< leaves the other side in all directions
    Rgb transmitted;       ///< refracted, or spread by a rough sheet
    float rest = 1.0f;     ///< covered share, which the Bsdf is of
};

/// What a surface does to a ray. The interface of opaque materials has the Fresnel term of their
/// Bsdf, so that mirrors and base together keep the energy of CookTorrance. That of glass has the
/// exact one. Of rough glass the shares are what specular_step() draws by, and no more.
[[nodiscard]] MIR_HD inline SpecularShares specular_shares(const SpecularSurface& s) {
    const MaterialFactors& f = s.factors;
    const bool smooth = is_smooth(f.roughness);
    const float clear = s.clear();
    // Segments know no shading normals, so that what goes straight on must not depend on them.
    const bool is_sheet = clear > 0.0f && f.is_thin;
    const float cosine = glm::dot(is_sheet ? s.geometric_normal : s.normal, s.wo);
    float reflected = clear > 0.0f ? s.dielectric(cosine) : 0.0f;
    // Some facets of a rough interface let light through, and some mirror it, whatever the mean
    // one does.
    if (!smooth) reflected = smaller(larger(reflected, 0.1f), 0.9f);

    SpecularShares shares;
    shares.rest = s.cover;
    shares.pass = straight_transmittance(f, s.cover, cosine);
    const float coat = s.coat(glm::dot(s.coat_normal, s.wo));
    shares.coated = s.cover * coat;
    shares.through = s.cover * s.through;
    if (clear > 0.0f && !(is_sheet && smooth))
        shares.transmitted = f.base_color * (s.cover * clear * (1.0f - reflected));
    const bool is_mirror = smooth && (clear > 0.0f || s.has_interface);
    if (!is_mirror && !(s.bounds_body() && !s.front)) return shares;
    shares.mirrored = s.cover * s.mirror(reflected, cosine) * ((1.0f - coat) * (1.0f - coat));
    return shares;
}

}  // namespace mir
