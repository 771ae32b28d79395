// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

namespace mir {

/// What a clear coat reflects: a second, colourless interface of index 1.5 on top of a surface, by
/// Schlick's term. Specular chains carry it, and the Bsdf below loses it on the way in and on the
/// way out. A value; host and device. Source: KHR_materials_clearcoat, with the loss on both ways,
/// so that light may be traced from either end.
struct Clearcoat {
    static constexpr float normal = 0.04f;  ///< reflectance at normal incidence

    float weight = 0.0f;  ///< share of the surface that is coated, 0..1

    /// Reflectance, 0..1, where `grazing` is (1 - cosine)^5.
    [[nodiscard]] MIR_HD float reflectance(float grazing) const {
        return weight * (normal + (1.0f - normal) * grazing);
    }

    /// Cosine-weighted mean of what the coat takes of light that passes an interface below it,
    /// whose reflectance is `f0` at normal and `f90` at grazing incidence, by Schlick's term.
    [[nodiscard]] MIR_HD float mean_taken(float f0, float f90) const {
        const float gain = f90 - f0;
        // Means of (1 - cos)^5 and of its square are 1/21 and 1/66.
        const float reflected_below = normal * f0 + ((1.0f - normal) * f0 + normal * gain) / 21.0f +
                                      (1.0f - normal) * gain / 66.0f;
        return weight * (normal + (1.0f - normal) / 21.0f - reflected_below);
    }
};

}  // namespace mir
