// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/shading/lobe_samples.hpp"
#include "mir/shading/sampled_light.hpp"
#include "mir/shading/sky_guide.hpp"

namespace mir {

/// Light of the environment at a luxel, estimated from `samples` directions. They are drawn by
/// luminance: f L_e cos / p averaged over the samples, with shadow rays from outside the scene. The
/// samples of luxels that share are one Kronecker sequence with a random shift, as those of
/// EmitterLight. Surfaces with a lobe look along LobeSamples, too. Directions that all luxels share
/// are VPLs at infinity. Unbiased. Host and device.
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
                                        SharedSamples shared, const Random& random,
                                        const SkyGuide* guide = nullptr) const {
        if (environment_.empty() || samples_ == 0) return {};
        const auto by_luminance = drawn(shared, random, guide);
        if constexpr (LobedBsdf<B>)
            if (LobeSamples<B>::are_for(s)) {
                const LobeSamples<B> lobe(s, shared, random);
                return mean(hit, s, lobe, by_luminance) + mean(hit, s, lobe, [&](std::uint32_t k) {
                           return seen(lobe.direction(k), guide);
                       });
            }
        return mean(hit, s, NoLobe{}, by_luminance);
    }

    /// The same from directions that all luxels share, and that no lobe chooses: VPLs at infinity.
    [[nodiscard]] MIR_HD Rgb from_vpls(const Hit& hit, const Surface<typename B::Params>& s,
                                       const Random& random) const {
        if (environment_.empty() || samples_ == 0) return {};
        return mean(hit, s, NoLobe{}, drawn({}, random, nullptr));
    }

    /// What one sample brings if nothing is in its way, W m^-2 sr^-1.
    [[nodiscard, gnu::always_inline]] MIR_HD static Rgb unshadowed(
        const Hit& hit, const Surface<typename B::Params>& s, const EnvironmentSample& from) {
        return reflected<B>(hit, s, from.direction) * from.radiance * (1.0f / from.pdf);
    }

    /// A point outside the scene in the unit direction `w`.
    [[nodiscard]] MIR_HD Vec3 outside(Vec3 from, Vec3 w) const { return sphere_.outside(from, w); }

 private:
    /// Draws of directions by luminance.
    [[nodiscard]] MIR_HD auto drawn(SharedSamples shared, const Random& random,
                                    const SkyGuide* guide) const {
        return [this, shared, guide, shift = Vec2(random.at(3), random.at(4))](std::uint32_t k) {
            const std::uint32_t i = k * shared.shares + shared.share;
            const Vec2 u = kronecker_point(shift, i);
            if (guide == nullptr) return environment_.sample(u);
            const GuidedNumbers guided = guide->draw(u);
            EnvironmentSample sample = environment_.sample(guided.numbers);
            sample.pdf *= guided.density;
            return sample;
        };
    }

    [[nodiscard]] MIR_HD EnvironmentSample seen(Vec3 w, const SkyGuide* guide) const {
        const Rgb light = environment_.radiance(w);
        const float guided = guide == nullptr ? 1.0f : guide->density(environment_.numbers(w));
        return {w, light, environment_.density(light) * guided};
    }

    template <class Lobe, class Draw>
    [[nodiscard]] MIR_HD Rgb mean(const Hit& hit, const Surface<typename B::Params>& s,
                                  const Lobe& lobe, const Draw& draw) const {
        return mean_of_samples(hit.position, visibility_, samples_, draw,
                               [hit, s, lobe, sphere = sphere_](const EnvironmentSample& from) {
                                   EnvironmentSample both = from;
                                   both.pdf += lobe.density(from.direction);
                                   return LitPoint{sphere.outside(hit.position, from.direction),
                                                   unshadowed(hit, s, both)};
                               });
    }

    EnvironmentView<space> environment_;
    BoundingSphere sphere_;
    V visibility_;
    std::uint32_t samples_;
};

}  // namespace mir
