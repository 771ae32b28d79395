// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/warp.hpp"
#include "mir/micro/texel_reach.hpp"

namespace mir {

/// Texels of a MicroBuffer that see the same projected solid angle of the hemisphere around a
/// normal: the unit square under square_to_cosine_hemisphere(). Host and device.
class CosineTexels {
 public:
    /// Whether the left and the right border of the square are one.
    static constexpr bool goes_around = false;

    /// `normal` is a unit vector.
    MIR_HD explicit CosineTexels(Vec3 normal) : frame_(Frame::around(normal)) {}

    /// Unit, in the world.
    [[nodiscard]] MIR_HD Vec3 direction(Vec2 u) const {
        return frame_.to_world(square_to_cosine_hemisphere(u));
    }
    /// Of directions, per steradian.
    [[nodiscard]] MIR_HD float density(Vec3 wi) const {
        return cosine_hemisphere_pdf(glm::dot(wi, frame_.normal));
    }
    /// The largest one at the zenith: nodes may be no larger than the smallest texel.
    [[nodiscard]] MIR_HD float largest_density(const SeenSphere&) const { return inv_pi; }

    /// Directions that meet the sphere lie at most a chord away from its centre's. The map from the
    /// disc to [-1, 1]^2 lengthens no way more than sqrt(1 + (pi/4)^2) 4 / pi < 1.62 times on an
    /// axis, that to the unit square by half.
    [[nodiscard]] MIR_HD TexelReach reach(const SeenSphere& sphere) const {
        if (sphere.is_around()) return {};
        const float reach = 0.81f * sphere.chord() + 1e-4f;
        const Vec3 w = frame_.to_local(sphere.direction);
        const Vec2 centre = disc_to_square({w.x, w.y});
        return {centre - reach, centre + reach};
    }

 private:
    /// Inverse of square_to_disc(); of points outside of the disc, that of their direction.
    [[nodiscard]] MIR_HD static Vec2 disc_to_square(Vec2 p) {
        const float r = smaller(sqrtf(glm::dot(p, p)), 1.0f);
        if (r == 0.0f) return {0.5f, 0.5f};
        const bool wide = fabsf(p.x) > fabsf(p.y);
        const float share = 4.0f * inv_pi * atanf(wide ? p.y / p.x : p.x / p.y);
        const float a = wide ? copysignf(r, p.x) : copysignf(r, p.y) * share;
        const float b = wide ? copysignf(r, p.x) * share : copysignf(r, p.y);
        return {0.5f * (a + 1.0f), 0.5f * (b + 1.0f)};
    }

    Frame frame_;
};

}  // namespace mir
