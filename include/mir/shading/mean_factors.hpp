// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/texture_image.hpp"

namespace mir {

/// The mean of a material. Its factors, the base colour times the mean of its texture. Other
/// textures and vertex colours are left out. Every texel counts alike, however large the part of a
/// surface that shows it.
inline MaterialFactors mean_factors(const Scene& scene, const Material& material) {
    MaterialFactors factors = material.factors();
    const Texture& texture = material.textures.base_color;
    if (texture.is_set())
        factors.base_color =
            factors.base_color * mean_of(scene.images[texture.image], TexelEncoding::srgb);
    return factors;
}

}  // namespace mir
