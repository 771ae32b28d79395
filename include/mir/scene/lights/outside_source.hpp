// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/light_source.hpp"
#include "mir/scene/lights/bounding_sphere.hpp"

namespace mir {

/// What lights from outside of the scene have in common. A base of such sources.
struct OutsideSource {
    /// How rays find it, see LightSource.
    static constexpr LightOrigin origin = LightOrigin::outside;

    BoundingSphere scene;  ///< through which the light enters

    /// A ray that leaves it, see LightSource.
    [[nodiscard]] MIR_HD Ray ray(Vec3 /*from*/, Vec3 normal, Vec2 u) const {
        return scene.ray(normal, u);
    }
    /// Density of ray() at a surface, m^-2, see LightSource.
    [[nodiscard]] MIR_HD double ray_density(Vec3 /*normal*/, Vec3 /*w*/, float cosine,
                                            float /*d2*/) const {
        return scene.ray_density(cosine);
    }
    /// Factor of the emission along a direction, see LightSource.
    [[nodiscard]] MIR_HD static float share(Vec3 /*normal*/, Vec3 /*w*/) { return 1.0f; }
    /// Power of a light path, W, see LightSource.
    [[nodiscard]] MIR_HD Rgb flux(const LightPoint& p, Vec3 /*w*/, float probability) const {
        return scene.flux(p, probability);
    }
};

}  // namespace mir
