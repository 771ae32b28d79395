// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vertex_attributes.hpp"
#include "mir/scene/material_factors.hpp"
#include "mir/scene/texture_view.hpp"

namespace mir {

/// Multiplies what lies above the base of a material, and what goes through it, by their textures
/// at the coordinates `uv`.
template <Space S>
MIR_HD void set_other_layers(MaterialFactors& factors, const MaterialTextures& of,
                             const TextureView<S>& textures, Vec2 uv) {
    const auto linear = [&](const Texture& t) {
        return t.is_set() ? textures.look_up(t, uv, TexelEncoding::linear) : Vec4(1.0f);
    };
    factors.transmission *= linear(of.transmission).x;
    factors.clearcoat *= linear(of.clearcoat).x;
    factors.clearcoat_roughness *= linear(of.clearcoat_roughness).y;
    factors.diffuse_transmission *= linear(of.diffuse_transmission).w;
    if (of.diffuse_transmission_color.is_set())
        factors.diffuse_transmission_color =
            factors.diffuse_transmission_color *
            textures.color(of.diffuse_transmission_color, uv, TexelEncoding::srgb);
}

/// A material at one point: `factors` times the vertex colour and the textures there.
template <Space S>
[[nodiscard]] MIR_HD MaterialFactors textured_factors(MaterialFactors factors,
                                                      const MaterialTextures& of,
                                                      const TextureView<S>& textures,
                                                      const VertexAttributes& at) {
    const Vec2 uv = at.texture_coordinates;
    factors.base_color = factors.base_color * at.color;
    if (of.base_color.is_set())
        factors.base_color =
            factors.base_color * textures.color(of.base_color, uv, TexelEncoding::srgb);
    if (of.metallic_roughness.is_set()) {
        const Rgb c = textures.color(of.metallic_roughness, uv, TexelEncoding::linear);
        factors.roughness *= c.g;
        factors.metallic *= c.b;
    }
    if (of.changes_other_layers()) set_other_layers(factors, of, textures, uv);
    return factors;
}

/// Share of a blended surface that is covered at a point, 0..1: `alpha` times that of the texture.
template <Space S>
[[nodiscard]] MIR_HD float covered_share(float alpha, const Texture& base_color,
                                         const TextureView<S>& textures,
                                         const VertexAttributes& at) {
    if (!base_color.is_set()) return alpha;
    return alpha * textures.look_up(base_color, at.texture_coordinates, TexelEncoding::linear).w;
}

}  // namespace mir
