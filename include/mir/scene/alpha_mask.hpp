// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/geometry_view.hpp"
#include "mir/scene/texture_view.hpp"

namespace mir {

/// Where surfaces of a material are: at points with alpha at the cutoff or above. Plain values that
/// kernels read. Source: glTF 2.0, 3.9.4, alpha mode MASK.
struct AlphaMask {
    float alpha = 1.0f;   ///< 0..1
    float cutoff = 0.0f;  ///< at least 0; 0: everywhere
    Texture texture{};    ///< its alpha multiplies `alpha`

    /// False for surfaces without holes.
    [[nodiscard]] MIR_HD bool is_set() const { return cutoff > 0.0f; }

    /// True when a surface with these texture coordinates is there.
    template <Space S>
    [[nodiscard]] MIR_HD bool is_solid(const TextureView<S>& textures, Vec2 uv) const {
        float a = alpha;
        if (texture.is_set()) a *= textures.look_up(texture, uv, TexelEncoding::linear).w;
        return a >= cutoff;
    }
};

/// What kernels read of the masks of a scene. Says which points of triangles are there, with the
/// same bits on host and device. A point that is not hides nothing and is no hit. A view;
/// thread-safe.
template <Space S>
struct AlphaMaskView {
    static constexpr Space space = S;  ///< where the arrays lie

    GeometryView<S> geometry;          ///< of the triangles that is_solid() is asked about
    const AlphaMask* masks = nullptr;  ///< by material; nullptr: no triangle has a mask
    TextureView<S> textures{};         ///< of the masks

    /// False when is_solid() is true everywhere and need not be asked.
    [[nodiscard]] MIR_HD bool exists() const { return masks != nullptr; }

    /// Itself: holes are the same for every segment.
    [[nodiscard]] MIR_HD const AlphaMaskView& between(Vec3 /*a*/, Vec3 /*b*/) const {
        return *this;
    }

    /// At barycentrics of the triangle's second and third corner.
    [[nodiscard]] MIR_HD bool is_solid(std::uint32_t triangle, Vec2 barycentrics) const {
        if (!exists()) return true;
        const AlphaMask& mask = masks[geometry.materials[triangle]];
        if (!mask.is_set()) return true;
        return mask.is_solid(textures,
                             geometry.attributes(triangle, barycentrics).texture_coordinates);
    }
};

}  // namespace mir
