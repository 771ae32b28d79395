// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"

namespace mir::builtin {

/// Indices of what a car is made of.
struct CarMaterials {
    std::uint32_t paint = 0;   ///< of the bodywork
    std::uint32_t trim = 0;    ///< dark plastic
    std::uint32_t rubber = 0;  ///< of the tyres
    std::uint32_t metal = 0;   ///< bright and brushed: rims, grille, pipes
    std::uint32_t fabric = 0;  ///< of seats and linings
    std::uint32_t tail = 0;    ///< tail lamps, switched off
};

/// Opaque material under an interface of the given roughness.
inline Material coated(std::string name, Rgb base, float roughness, float metallic = 0.0f) {
    Material m;
    m.name = std::move(name);
    m.base_color = base;
    m.roughness = roughness;
    m.metallic = metallic;
    return m;
}

/// Adds the materials of a car to a scene.
inline CarMaterials add_car_materials(Scene& s) {
    CarMaterials m;
    m.paint = s.add(coated("paint", {0.5f, 0.06f, 0.05f}, 0.45f));
    m.trim = s.add(coated("trim", {0.03f, 0.03f, 0.035f}, 0.6f));
    m.rubber = s.add(lambertian("rubber", {0.045f, 0.045f, 0.045f}));
    m.metal = s.add(coated("metal", {0.72f, 0.72f, 0.74f}, 0.5f, 0.6f));
    m.fabric = s.add(lambertian("fabric", {0.36f, 0.27f, 0.18f}));
    m.tail = s.add(coated("tail lamp", {0.45f, 0.02f, 0.02f}, 0.4f));
    return m;
}

}  // namespace mir::builtin
