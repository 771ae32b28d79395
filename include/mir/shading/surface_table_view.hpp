// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/core/ray.hpp"
#include "mir/core/space.hpp"
#include "mir/data/luxel.hpp"
#include "mir/scene/geometry_view.hpp"
#include "mir/scene/see_through.hpp"
#include "mir/scene/texture_view.hpp"
#include "mir/scene/textured_factors.hpp"
#include "mir/shading/material_params.hpp"

#include <concepts>

namespace mir {

/// A Bsdf whose parameters follow textures and vertex colours. material_params() knows how one
/// point of a material reflects.
template <class B>
concept TexturedBsdf = Bsdf<B> && requires(const MaterialFactors& factors) {
    { material_params(factors, B{}) } -> std::same_as<typename B::Params>;
};

/// A Bsdf whose surfaces are followed as mirrors and glass: it may end their chains, and knows one
/// point of a material.
template <class B>
concept SpecularBsdf = SpecularEndBsdf<B> && TexturedBsdf<B>;

/// What chains leave to the Bsdf of a material: all of it but the lobes that are no wider than a
/// direction.
template <Bsdf B>
[[nodiscard]] MIR_HD typename B::Params specular_end_params(const typename B::Params& all,
                                                            float roughness) {
    if constexpr (SpecularBsdf<B>)
        if (is_smooth(roughness)) return B::without_lobe(all);
    return all;
}

/// One material in the parameters of a Bsdf.
template <Bsdf B>
struct SurfaceEntry {
    typename B::Params params;    ///< without textures and vertex colours
    Rgb emission;                 ///< radiance, W m^-2 sr^-1
    bool both_sides = false;      ///< emits from the back too
    float lobe_share = 0.0f;      ///< of the mean albedo: what the interface reflects, 0..1; 0 only
                                  ///< where Material::is_lambertian()
    float mean_albedo = 0.0f;     ///< luminance of the reflectance at a typical angle, 0..1
    MaterialFactors factors{};    ///< what textures multiply
    MaterialTextures textures{};  ///< of the material; may be none
    bool is_specular = false;     ///< rays may go on from it as specular chains
    bool is_blended = false;      ///< Material::is_blended
    float alpha = 1.0f;           ///< Material::alpha
    Rgb absorption{};             ///< of a body of it, per metre
};

/// What kernels read of a SurfaceTable. A view; thread-safe.
template <Space S, Bsdf B>
struct SurfaceTableView {
    static constexpr Space space = S;  ///< memory that the arrays lie in
    /// What a luxel knows of its surface.
    using Surface = mir::Surface<typename B::Params>;

    const SurfaceEntry<B>* entries = nullptr;  ///< by material
    TextureView<S> textures;                   ///< that entries refer to

    /// Surface data of a point for light that leaves along the unit vector `wo`.
    [[nodiscard]] MIR_HD Surface surface(const SurfacePoint& p, Vec3 wo) const {
        return surface(p, wo, shading_normal(p));
    }
    /// The same of a luxel that is seen from the direction `wo`, with seen_normal().
    [[nodiscard]] MIR_HD Surface luxel_surface(const SurfacePoint& p, Vec3 wo) const {
        return surface(p, wo, seen_normal(p, wo));
    }

    /// Parameters of a point with these attributes.
    [[nodiscard]] MIR_HD typename B::Params params(std::uint32_t material,
                                                   const VertexAttributes& at) const;
    /// Parameters without textures and vertex colours.
    [[nodiscard]] MIR_HD const typename B::Params& params(std::uint32_t material) const {
        return entries[material].params;
    }

    /// Unit shading normal bent by the normal texture, on the geometric one's side. Where it would
    /// turn away from the surface, the one of the vertices. It does not depend on where the point
    /// is seen from: every way to sample a path means the same path.
    [[nodiscard]] MIR_HD Vec3 shading_normal(const SurfacePoint& p) const {
        if (!entries[p.material].textures.normal.is_set()) return p.shading_normal;
        return bent_normal(p);
    }
    /// The shading normal of a luxel, which the camera sees from `wo`. It is shading_normal(),
    /// unless it turns away from there; then that of the vertices, unless that does too; then the
    /// geometric one. Luxels are the only points that every sampler sees from one direction.
    [[nodiscard]] MIR_HD Vec3 seen_normal(const SurfacePoint& p, Vec3 wo) const {
        const Vec3 bent = shading_normal(p);
        if (glm::dot(bent, wo) > 0.0f) return bent;
        return glm::dot(p.shading_normal, wo) > 0.0f ? p.shading_normal : p.geometric_normal;
    }
    /// The normal of a clear coat, which knows no normal texture, seen from `wo`.
    [[nodiscard]] MIR_HD static Vec3 coat_normal(const SurfacePoint& p, Vec3 wo) {
        return glm::dot(p.shading_normal, wo) > 0.0f ? p.shading_normal : p.geometric_normal;
    }
    /// How the rough coat of a material reflects at a point with these attributes, which it must
    /// have.
    [[nodiscard]] MIR_HD typename B::Params coat(std::uint32_t material,
                                                 const VertexAttributes& at) const {
        const MaterialFactors m = factors(material, at);
        if constexpr (requires { B::coat(m.clearcoat, m.clearcoat_roughness); })
            return B::coat(m.clearcoat, m.clearcoat_roughness);
        else
            return {};
    }
    /// How one side of a surface sends out diffusely what arrives on the other: as if it had
    /// arrived here, from the opposite direction.
    [[nodiscard]] MIR_HD static typename B::Params through(const MaterialFactors& m) {
        if constexpr (SpecularBsdf<B>)
            return B::without_lobe(material_params(m.through(), B{}));
        else
            return {};
    }
    /// The same of a material at a point with these attributes.
    [[nodiscard]] MIR_HD typename B::Params through(std::uint32_t material,
                                                    const VertexAttributes& at) const {
        return through(factors(material, at));
    }
    /// Chance with which a path goes on at the other side of a surface: by what goes through
    /// diffusely and what is reflected, at normal incidence. It depends on the point alone, so
    /// that a path has the same chance from both its ends.
    [[nodiscard]] MIR_HD float through_chance(std::uint32_t material,
                                              const VertexAttributes& at) const;
    /// True when rays that meet the material may go on as specular chains. Never of a model that
    /// cannot stand at their end.
    [[nodiscard]] MIR_HD bool is_specular(std::uint32_t material) const {
        if constexpr (SpecularBsdf<B>)
            return entries[material].is_specular;
        else
            return false;
    }
    /// The material at a point with these attributes, textures and vertex colours included.
    [[nodiscard]] MIR_HD MaterialFactors factors(std::uint32_t material,
                                                 const VertexAttributes& at) const {
        return factors(entries[material], at);
    }
    /// Share of the surface that a blended material covers there, 0..1; 1 of others.
    [[nodiscard]] MIR_HD float coverage(std::uint32_t material, const VertexAttributes& at) const {
        const SurfaceEntry<B>& e = entries[material];
        return e.is_blended ? covered_share(e.alpha, e.textures.base_color, textures, at) : 1.0f;
    }
    /// True for what is inside of a body: there chains carry the lobe of a rough surface, too.
    [[nodiscard]] MIR_HD bool is_inside_body(std::uint32_t material, bool front) const {
        const MaterialFactors& f = entries[material].factors;
        return !front && !f.is_thin && f.transmission > 0.0f && f.metallic < 1.0f;
    }
    /// What of the parameters `p` of a material chains leave to one of its sides.
    [[nodiscard]] MIR_HD typename B::Params params_of_side(const typename B::Params& p,
                                                           std::uint32_t material,
                                                           bool front) const {
        if constexpr (SpecularBsdf<B>)
            if (is_inside_body(material, front)) return B::without_lobe(p);
        return p;
    }
    /// True where the side of a point that is met emits light.
    [[nodiscard]] MIR_HD bool shines(const SurfacePoint& p) const {
        const SurfaceEntry<B>& e = entries[p.material];
        return (p.front || e.both_sides) && !is_black(e.emission);
    }
    /// What a body of the material absorbs, per metre.
    [[nodiscard]] MIR_HD Rgb absorption(std::uint32_t material) const {
        return entries[material].absorption;
    }

    /// True when the material reflects alike in all directions (Material::is_lambertian()).
    [[nodiscard]] MIR_HD bool is_lambertian(std::uint32_t material) const {
        return entries[material].lobe_share == 0.0f;
    }
    /// Share of the reflected light at a typical angle that leaves in a lobe, 0..1. 0 only where
    /// is_lambertian().
    [[nodiscard]] MIR_HD float lobe_share(std::uint32_t material) const {
        return entries[material].lobe_share;
    }
    /// Parameters of a point where the material is `m`.
    [[nodiscard]] MIR_HD static typename B::Params textured_params(
        const MaterialFactors& m) requires TexturedBsdf<B> {
        return specular_end_params<B>(material_params(m, B{}), m.roughness);
    }

 private:
    [[nodiscard]] MIR_HD Surface surface(const SurfacePoint& p, Vec3 wo, Vec3 normal) const {
        const SurfaceEntry<B>& e = entries[p.material];
        return {normal, wo, p.front || e.both_sides ? emission(e, p) : Rgb{},
                params(p.material, attributes_of(p))};
    }
    [[nodiscard]] MIR_HD Rgb emission(const SurfaceEntry<B>& e, const SurfacePoint& p) const {
        const Texture& texture = e.textures.emission;
        Rgb light = e.emission;
        if (e.is_blended) light = light * coverage(p.material, attributes_of(p));
        if (!texture.is_set()) return light;
        return light * textures.color(texture, p.texture_coordinates, TexelEncoding::srgb);
    }
    [[nodiscard]] MIR_HD MaterialFactors factors(const SurfaceEntry<B>& e,
                                                 const VertexAttributes& at) const;
    [[nodiscard]] MIR_HD Vec3 bent_normal(const SurfacePoint& p) const;
};

template <Space S, Bsdf B>
MIR_HD typename B::Params SurfaceTableView<S, B>::params(std::uint32_t material,
                                                         const VertexAttributes& at) const {
    const SurfaceEntry<B>& e = entries[material];
    if constexpr (TexturedBsdf<B>) {
        const bool is_white = at.color.r == 1.0f && at.color.g == 1.0f && at.color.b == 1.0f;
        if (!is_white || e.textures.changes_reflection()) return textured_params(factors(e, at));
    }
    return e.params;
}

template <Space S, Bsdf B>
MIR_HD MaterialFactors SurfaceTableView<S, B>::factors(const SurfaceEntry<B>& e,
                                                       const VertexAttributes& at) const {
    return textured_factors(e.factors, e.textures, textures, at);
}

template <Space S, Bsdf B>
MIR_HD float SurfaceTableView<S, B>::through_chance(std::uint32_t material,
                                                    const VertexAttributes& at) const {
    if constexpr (SpecularBsdf<B>) {
        if (!(entries[material].factors.diffuse_transmission > 0.0f)) return 0.0f;
        const MaterialFactors m = factors(material, at);
        if (!(m.diffuse_transmission > 0.0f)) return 0.0f;
        const Vec3 n(0.0f, 0.0f, 1.0f);
        const float through_it = luminance(B::albedo(through(m), n, n));
        const float back = luminance(B::albedo(textured_params(m), n, n));
        if (!(through_it > 0.0f)) return 0.0f;
        if (!(back > 0.0f)) return 1.0f;
        return smaller(larger(through_it / (through_it + back), 0.1f), 0.9f);
    } else {
        return 0.0f;
    }
}

/// Source: Khronos glTF 2.0 specification, 3.9.3 (normal textures).
template <Space S, Bsdf B>
MIR_HD Vec3 SurfaceTableView<S, B>::bent_normal(const SurfacePoint& p) const {
    const SurfaceEntry<B>& e = entries[p.material];
    const Rgb c = textures.color(e.textures.normal, p.texture_coordinates, TexelEncoding::linear);
    const Vec3 front = p.front ? p.shading_normal : -p.shading_normal;
    const Vec3 along = p.tangent - glm::dot(p.tangent, front) * front;
    const float length = glm::length(along);
    if (!(length > 0.0f)) return p.shading_normal;
    const Vec3 x = along / length;
    const Vec3 y = (p.mirrored_texture ? -1.0f : 1.0f) * glm::cross(front, x);
    const float scale = e.textures.normal_scale;
    const Vec3 bent = (2.0f * c.r - 1.0f) * scale * x + (2.0f * c.g - 1.0f) * scale * y +
                      (2.0f * c.b - 1.0f) * front;
    const float size = glm::length(bent);
    if (!(size > 0.0f)) return p.shading_normal;
    const Vec3 n = (p.front ? 1.0f : -1.0f) / size * bent;
    return glm::dot(n, p.geometric_normal) > 0.0f ? n : p.shading_normal;
}

}  // namespace mir
