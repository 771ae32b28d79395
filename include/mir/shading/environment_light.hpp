// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/shading/sampled_light.hpp"

namespace mir {

/// Light of the environment at a luxel, estimated from `samples` directions. They are drawn by
/// luminance: f L_e cos / p averaged over the samples, with shadow rays from outside the scene. The
/// samples of luxels that share are one Kronecker sequence with a random shift, as those of
/// EmitterLight. Directions that all luxels share are VPLs at infinity. Unbiased. Host and device.
template <Bsdf B, Visibility V>
class EnvironmentLight {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the environment lies in

    /// `samples` per luxel, 0 for no light. What the view reads must outlive it.
    EnvironmentLight(const LightTableView<space>& lights, V visibility, std::uint32_t samples)
        : environment_(lights.environment),
          sphere_(lights.sphere),
          visibility_(visibility),
          samples_(samples) {}
    /// The environment of lights of the host, which must outlive it.
    EnvironmentLight(const LightTable& lights, V visibility,
                     std::uint32_t samples) requires(space == Space::host)
        : EnvironmentLight(lights.view(), visibility, samples) {}

    /// W m^-2 sr^-1 towards the viewer. `random` must be the same for all luxels that share; of
    /// its numbers the fourth and fifth are used, which EmitterLight leaves. Safe to call from any
    /// thread.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                        SharedSamples shared, const Random& random) const {
        if (environment_.empty() || samples_ == 0) return {};
        const Vec2 shift(random.at(3), random.at(4));
        return mean_of_samples(
            hit.position, visibility_, samples_,
            [&](std::uint32_t k) {
                const std::uint32_t i = k * shared.shares + shared.share;
                return environment_.sample(kronecker_point(shift, i));
            },
            [hit, s, sphere = sphere_](const EnvironmentSample& from) {
                return LitPoint{sphere.outside(hit.position, from.direction),
                                unshadowed(hit, s, from)};
            });
    }

    /// What one sample brings if nothing is in its way, W m^-2 sr^-1.
    [[nodiscard, gnu::always_inline]] MIR_HD static Rgb unshadowed(
        const Hit& hit, const Surface<typename B::Params>& s, const EnvironmentSample& from) {
        return reflected<B>(hit, s, from.direction) * from.radiance * (1.0f / from.pdf);
    }

    /// A point outside the scene in the unit direction `w`.
    [[nodiscard]] MIR_HD Vec3 outside(Vec3 from, Vec3 w) const { return sphere_.outside(from, w); }

 private:
    EnvironmentView<space> environment_;
    BoundingSphere sphere_;
    V visibility_;
    std::uint32_t samples_;
};

}  // namespace mir
