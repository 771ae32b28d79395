// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/environment_view.hpp"
#include "mir/scene/lights/outside_source.hpp"

namespace mir {

/// An environment as one light among others. Model of LightSource; must not be empty.
template <Space S>
struct EnvironmentSource : OutsideSource {
    /// Whether a point or a direction is drawn, see LightSource.
    static constexpr bool has_extent = true;

    const EnvironmentView<S>& environment;  ///< outlives this

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
    /// Luminance of the power that enters the scene, W.
    [[nodiscard]] double power() const {
        const double disc = static_cast<double>(pi) * scene.radius * scene.radius;
        return environment.total() * disc;
    }
};

}  // namespace mir
