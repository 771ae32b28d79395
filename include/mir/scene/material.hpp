// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/material_factors.hpp"
#include "mir/scene/texture.hpp"

#include <limits>
#include <string>

namespace mir {

/// The one material of a Scene: a diffuse base under a Cook-Torrance interface. Parameters are
/// glTF's metallic-roughness ones. Both faces reflect. `specular` = 0 and `metallic` = 0 make it
/// purely Lambertian.
struct Material {
    std::string name;                  ///< for messages and files
    Rgb base_color{0.8f, 0.8f, 0.8f};  ///< linear reflectance, 0..1
    float metallic = 0.0f;             ///< 0..1
    float roughness = 1.0f;            ///< 0..1, GGX alpha is its square
    float specular = 1.0f;             ///< weight of the dielectric interface, 0..1
    float ior = 1.5f;                  ///< index of refraction of the dielectric interface, >= 1
    /// Radiance of the front, W m^-2 sr^-1. Of a blended surface that of its covered share.
    Rgb emission;
    bool emits_from_both_sides = false;  ///< the back with the front's radiance
    std::uint16_t light_group = 0;       ///< group that its light is counted in
    MaterialTextures textures;           ///< multiply what stands above, point by point
    /// 0..1, times that of textures.base_color. Masks and blended materials use it.
    float alpha = 1.0f;
    float alpha_cutoff = 0.0f;  ///< points with less alpha are not there; 0: all are
    bool is_blended = false;    ///< alpha is the covered share of the surface (glTF: BLEND)
    float transmission = 0.0f;  ///< MaterialFactors::transmission
    bool is_thin = true;        ///< MaterialFactors::is_thin
    /// Share of light that a body of it leaves after `attenuation_distance`, 0..1.
    Rgb attenuation_color{1.0f, 1.0f, 1.0f};
    float attenuation_distance = std::numeric_limits<float>::infinity();  ///< metres

    float clearcoat = 0.0f;             ///< MaterialFactors::clearcoat
    float clearcoat_roughness = 0.0f;   ///< MaterialFactors::clearcoat_roughness
    float diffuse_transmission = 0.0f;  ///< MaterialFactors::diffuse_transmission
    Rgb diffuse_transmission_color{1.0f, 1.0f,
                                   1.0f};  ///< MaterialFactors::diffuse_transmission_color

    /// True when its emission is not black, whatever its texture.
    [[nodiscard]] bool emits() const { return !is_black(emission); }
    /// How it reflects without textures and vertex colours.
    [[nodiscard]] MaterialFactors factors() const {
        return {base_color,
                metallic,
                roughness,
                specular,
                ior,
                transmission,
                is_thin,
                clearcoat,
                clearcoat_roughness,
                diffuse_transmission,
                diffuse_transmission_color};
    }
    /// True when it may have holes.
    [[nodiscard]] bool is_masked() const { return alpha_cutoff > 0.0f; }
    /// True when light may go straight through it somewhere without a change of direction.
    [[nodiscard]] bool is_see_through() const {
        return is_blended || (transmission > 0.0f && is_thin && metallic < 1.0f);
    }
    /// True when light may go through it diffusely.
    [[nodiscard]] bool is_translucent() const {
        return diffuse_transmission > 0.0f && metallic < 1.0f;
    }
    /// True when all light passes it unchanged. It is as if it were not there, in every bit.
    [[nodiscard]] bool is_nothing() const {
        if (emits() || textures.base_color.is_set() || textures.transmission.is_set()) return false;
        if (is_blended && alpha == 0.0f) return true;
        const bool clear = transmission == 1.0f && metallic == 0.0f && roughness == 0.0f;
        return clear && is_thin && ior == 1.0f && base_color == Rgb{1.0f, 1.0f, 1.0f};
    }
    /// True when it has no specular part. Textures do not change that, because they multiply.
    [[nodiscard]] bool is_lambertian() const {
        return metallic == 0.0f && specular == 0.0f && transmission == 0.0f && clearcoat == 0.0f;
    }
};

/// Ideal diffuse material of the given reflectance, without emission.
inline Material lambertian(std::string name, Rgb reflectance) {
    Material m;
    m.name = std::move(name);
    m.base_color = reflectance;
    m.specular = 0.0f;
    return m;
}

/// Lambertian material that shines with `radiance` (W m^-2 sr^-1) from its front.
inline Material emitter(std::string name, Rgb reflectance, Rgb radiance) {
    Material m = lambertian(std::move(name), reflectance);
    m.emission = radiance;
    return m;
}

}  // namespace mir
