// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shading/surface_table.hpp"

#include <vector>

namespace mir {

/// Reflectance of each material at a typical angle, 0..1: the Lambertian surface that its discs are
/// taken for. Exact for Lambertian materials; others keep their power and lose their shape.
template <Bsdf B>
std::vector<Rgb> material_albedo(const SurfaceTable<B>& surfaces) {
    std::vector<Rgb> albedo;
    for (const SurfaceEntry<B>& entry : surfaces.entries())
        albedo.push_back(B::albedo(entry.params, {0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}));
    return albedo;
}

}  // namespace mir
