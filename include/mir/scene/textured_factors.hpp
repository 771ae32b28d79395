// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vertex_attributes.hpp"
#include "mir/scene/material_factors.hpp"
#include "mir/scene/texture_view.hpp"

namespace mir {

/// A material at one point: `factors` times the vertex colour and the textures there.
template <Space S>
[[nodiscard]] MIR_HD MaterialFactors textured_factors(MaterialFactors factors,
                                                      const Texture& base_color,
                                                      const Texture& metallic_roughness,
                                                      const TextureView<S>& textures,
                                                      const VertexAttributes& at) {
    factors.base_color = factors.base_color * at.color;
    if (base_color.is_set())
        factors.base_color = factors.base_color * textures.color(base_color, at.texture_coordinates,
                                                                 TexelEncoding::srgb);
    if (metallic_roughness.is_set()) {
        const Rgb c =
            textures.color(metallic_roughness, at.texture_coordinates, TexelEncoding::linear);
        factors.roughness *= c.g;
        factors.metallic *= c.b;
    }
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
