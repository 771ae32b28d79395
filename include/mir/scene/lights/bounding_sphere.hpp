// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/ray.hpp"
#include "mir/core/warp.hpp"
#include "mir/data/light_point.hpp"

namespace mir {

/// Bounding sphere of a scene, through which light from outside enters it.
struct BoundingSphere {
    Vec3 centre{0};       ///< metres
    float radius = 0.0f;  ///< metres

    /// A ray of the light that travels along the unit vector `w`. Uniform over the sphere's disc.
    [[nodiscard]] MIR_HD Ray ray(Vec3 w, Vec2 u) const {
        const Frame frame = Frame::around(w);
        const Vec2 disc = radius * square_to_disc(u);
        const Vec3 on_disc = disc.x * frame.tangent + disc.y * frame.bitangent;
        return {centre + on_disc - 2.0f * radius * w, w};
    }
    /// Density of ray() per m^2 of a surface with cosine `cosine`.
    [[nodiscard]] MIR_HD double ray_density(float cosine) const {
        return static_cast<double>(cosine) / (static_cast<double>(pi) * radius * radius);
    }
    /// Power of a ray() that starts at `p`, W: LightSource::flux().
    [[nodiscard]] MIR_HD Rgb flux(const LightPoint& p, float probability) const {
        return p.emission * (1.0f / (p.pdf_start() * probability)) * (pi * radius * radius);
    }
    /// A point outside the scene, seen from `from` inside along the unit vector `w`.
    [[nodiscard]] MIR_HD Vec3 outside(Vec3 from, Vec3 w) const { return from + 4.0f * radius * w; }
};

}  // namespace mir
