// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/light_source.hpp"
#include "mir/scene/environment_view.hpp"
#include "mir/scene/lights/bounding_sphere.hpp"

namespace mir {

/// An environment as one light among others. Model of LightSource; must not be empty.
template <Space S>
struct EnvironmentSource {
    /// How rays find it, see LightSource.
    static constexpr LightOrigin origin = LightOrigin::outside;
    /// Whether a point or a direction is drawn, see LightSource.
    static constexpr bool has_extent = true;

    const EnvironmentView<S>& environment;  ///< outlives this
    BoundingSphere scene;                   ///< through which it enters

    /// A point of it for a receiver, see LightSource.
    [[nodiscard]] MIR_HD LightPoint sample(Vec2 u, Vec3 /*from*/) const { return start(u, 0.0f); }
    /// A point of it where a light path begins, see LightSource.
    [[nodiscard]] MIR_HD LightPoint start(Vec2 u, float /*side*/) const {
        const EnvironmentSample s = environment.sample(u);
        LightPoint p;
        p.normal = -s.direction;
        p.emission = s.radiance;
        p.pdf = s.pdf;
        p.light_group = environment.light_group;
        return p;
    }
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
    /// Luminance of the power that enters the scene, W.
    [[nodiscard]] double power() const {
        const double disc = static_cast<double>(pi) * scene.radius * scene.radius;
        return environment.total() * disc;
    }
};

}  // namespace mir
