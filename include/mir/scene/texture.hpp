// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>
#include <initializer_list>

namespace mir {

/// What lies beyond an image, in each direction of its own.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// An image as one part of a material uses it. Plain values that kernels read.
struct Texture {
    /// No image: the texture changes nothing.
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    std::uint32_t image = none;  ///< index into Scene::images
    Wrap wrap_u = Wrap::repeat;  ///< beyond the left and right edges
    Wrap wrap_v = Wrap::repeat;  ///< beyond the upper and lower edges
    bool nearest = false;        ///< the texel that a point lies in, instead of a bilinear mean
    Vec2 u_axis{1, 0};           ///< what the mesh's u adds to (u, v) of the image
    Vec2 v_axis{0, 1};           ///< what the mesh's v adds
    Vec2 offset{0};              ///< added to (u, v) of the image

    /// False when it changes nothing.
    [[nodiscard]] MIR_HD bool is_set() const { return image != none; }
    /// Where texture coordinates lie in the image. (0, 0) is the top left, (1, 1) the bottom right.
    [[nodiscard]] MIR_HD Vec2 place(Vec2 uv) const {
        return u_axis * uv.x + v_axis * uv.y + offset;
    }
};

/// Every texture of a material.
struct MaterialTextures {
    Texture base_color;            ///< sRGB; multiplies Material::base_color, and its alpha alpha
    Texture metallic_roughness;    ///< linear; green multiplies roughness, blue metallic
    Texture normal;                ///< linear; tangent space, +y against the image's v
    Texture emission;              ///< sRGB; multiplies Material::emission
    float normal_scale = 1.0f;     ///< of x and y of `normal`
    Texture transmission;          ///< linear; red multiplies Material::transmission
    Texture clearcoat;             ///< linear; red multiplies Material::clearcoat
    Texture clearcoat_roughness;   ///< linear; green multiplies that of Material
    Texture diffuse_transmission;  ///< linear; alpha multiplies that of Material
    Texture diffuse_transmission_color;  ///< sRGB; multiplies that of Material

    /// True when it makes the reflectance vary. Normal maps, which turn it, do not count.
    [[nodiscard]] MIR_HD bool changes_reflection() const {
        return base_color.is_set() || metallic_roughness.is_set() || changes_other_layers();
    }
    /// True when what lies above the base varies, or what goes through it.
    [[nodiscard]] MIR_HD bool changes_other_layers() const {
        return transmission.is_set() || clearcoat.is_set() || clearcoat_roughness.is_set() ||
               diffuse_transmission.is_set() || diffuse_transmission_color.is_set();
    }
    /// Calls f with each texture, in the order of the members.
    template <class F>
    void for_each(F&& f) const {
        for (const Texture* t :
             {&base_color, &metallic_roughness, &normal, &emission, &transmission, &clearcoat,
              &clearcoat_roughness, &diffuse_transmission, &diffuse_transmission_color})
            f(*t);
    }
};

}  // namespace mir
