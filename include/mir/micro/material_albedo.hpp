// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shading/mean_factors.hpp"
#include "mir/shading/surface_table_view.hpp"

#include <vector>

namespace mir {

/// Reflectance of each material of a scene at a typical angle, 0..1, by the mean of its base colour
/// texture where the Bsdf knows textures: the Lambertian surface that its discs are taken for.
/// Exact for Lambertian materials of one colour; others keep their power and lose their shape.
template <Bsdf B>
std::vector<Rgb> material_albedo(const Scene& scene) {
    const auto params = [&](const Material& m) {
        if constexpr (TexturedBsdf<B>)
            return material_params(mean_factors(scene, m), B{});
        else
            return material_params(m, B{});
    };
    std::vector<Rgb> albedo;
    for (const Material& m : scene.materials)
        albedo.push_back(B::albedo(params(m), {0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}));
    return albedo;
}

}  // namespace mir
