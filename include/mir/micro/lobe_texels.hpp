// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/unit_circle.hpp"
#include "mir/micro/texel_reach.hpp"
#include "mir/shading/reflection_lobe.hpp"

namespace mir {

/// Texels of a micro-buffer that share a ReflectionLobe evenly. Around its axis from left to right,
/// away from it from bottom to top. Host and device.
class LobeTexels {
 public:
    /// Whether the left and the right border of the square are one.
    static constexpr bool goes_around = true;

    /// Around +z, as even as can be.
    LobeTexels() = default;
    /// `lobe` is sharper than 0.
    MIR_HD explicit LobeTexels(const ReflectionLobe& lobe)
        : frame_(Frame::around(lobe.axis)), k_(lobe.sharpness) {}

    /// True when the same places of the square are the same directions.
    [[nodiscard]] MIR_HD bool is_like(const LobeTexels& other) const {
        return frame_.normal == other.frame_.normal && k_ == other.k_;
    }
    /// Unit, in the world.
    [[nodiscard]] MIR_HD Vec3 direction(Vec2 u) const {
        const float part = 2.0f * u.y / (1.0f + 2.0f * k_);
        const float x = smaller(part / (1.0f - k_ * part), 2.0f);
        return frame_.to_world({sqrtf(x * (2.0f - x)) * unit_circle(u.x), 1.0f - x});
    }
    /// Of directions, per steradian.
    [[nodiscard]] MIR_HD float density(Vec3 wi) const {
        return density_at(larger(0.0f, 1.0f - glm::dot(wi, frame_.normal)));
    }
    /// Of the directions that meet a sphere, or a little more.
    [[nodiscard]] MIR_HD float largest_density(const SeenSphere& sphere) const {
        if (sphere.is_around()) return density_at(0.0f);
        return density_at(Away(frame_.to_local(sphere.direction), sphere).nearest);
    }

    /// What largest_density() is at least, of any sphere.
    [[nodiscard]] MIR_HD float least_density() const { return density_at(2.0f); }
    /// And at most.
    [[nodiscard]] MIR_HD float most_density() const { return density_at(0.0f); }

    /// Texels of directions that meet a sphere at `to_centre`. A little is added for the
    /// rounding of directions, which counts as k does in the one axis and near the poles in the
    /// other.
    [[nodiscard]] MIR_HD TexelReach reach(Vec3 to_centre, float radius) const {
        const SeenSphere sphere(to_centre, radius);
        TexelReach reach;
        if (sphere.is_around()) return reach;
        const Vec3 w = frame_.to_local(sphere.direction);
        const Away away(w, sphere);
        const float margin = 1e-4f + 0x1p-20f * k_;
        reach.low.y = height_of(away.nearest) - margin;
        reach.high.y = height_of(away.farthest) + margin;
        const float across = sqrtf(w.x * w.x + w.y * w.y);
        if (across > 1e-3f && sphere.sine < across) {
            const float turn =
                atan2f(sphere.sine, sqrtf((across - sphere.sine) * (across + sphere.sine)));
            const float half = 0.5f * inv_pi * turn + 1e-4f + 1e-6f / across;
            const float centre = 0.5f * inv_pi * atan2f(w.y, w.x);
            reach.low.x = centre - half;
            reach.high.x = centre + half;
        }
        return reach;
    }

 private:
    /// x = 1 - cos of the angle to the axis, over a sphere's directions. The sphere lies at `w`.
    struct Away {
        float nearest = 0.0f;
        float farthest = 2.0f;

        MIR_HD Away(Vec3 w, const SeenSphere& sphere) {
            const float cosine = sphere.cosine();
            const float along = w.z * cosine;
            const float aside = sqrtf(larger(0.0f, w.x * w.x + w.y * w.y)) * sphere.sine;
            if (w.z < cosine) nearest = larger(0.0f, 1.0f - (along + aside));
            if (w.z > -cosine) farthest = smaller(2.0f, 1.0f - (along - aside));
        }
    };

    [[nodiscard]] MIR_HD float density_at(float x) const {
        const float fall = 1.0f + k_ * x;
        return (1.0f + 2.0f * k_) * 0.25f * inv_pi / (fall * fall);
    }
    /// Of the square: the share of directions that are nearer.
    [[nodiscard]] MIR_HD float height_of(float x) const {
        return 0.5f * x * (1.0f + 2.0f * k_) / (1.0f + k_ * x);
    }

    Frame frame_;
    float k_ = 0.0f;
};

}  // namespace mir
