// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

namespace mir {

/// A material at one point: a diffuse base under a Cook-Torrance interface. Parameters are glTF's
/// metallic-roughness ones. Plain values that kernels read.
struct MaterialFactors {
    Rgb base_color{0.8f, 0.8f, 0.8f};  ///< linear reflectance, 0..1
    float metallic = 0.0f;             ///< 0..1
    float roughness = 1.0f;            ///< 0..1, GGX alpha is its square
    float specular = 1.0f;             ///< weight of the dielectric interface, 0..1
    float ior = 1.5f;                  ///< index of refraction of the dielectric interface, >= 1
    /// Share of the light below the interface that goes through, 0..1. It is tinted by
    /// `base_color`; the rest is diffuse. Metals let nothing through.
    float transmission = 0.0f;
    bool is_thin = true;  ///< a sheet that light leaves as it came; false: the surface of a body
    float clearcoat =
        0.0f;  ///< weight of a second, colourless interface on top, 0..1; not on glass
    float clearcoat_roughness = 0.0f;  ///< of that one, 0..1
    /// Share of diffuse reflection that goes through instead, 0..1. It leaves the other side in all
    /// directions: leaves, paper. Metals let nothing through.
    float diffuse_transmission = 0.0f;
    Rgb diffuse_transmission_color{1.0f, 1.0f, 1.0f};  ///< of that light, 0..1

    /// The material as its other side sends out light. The base is what goes through diffusely,
    /// and what goes through is the base.
    [[nodiscard]] MIR_HD MaterialFactors through() const {
        MaterialFactors m = *this;
        m.base_color = diffuse_transmission_color;
        m.diffuse_transmission = 1.0f - diffuse_transmission;
        return m;
    }
};

}  // namespace mir
