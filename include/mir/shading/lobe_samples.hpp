// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/data/luxel.hpp"
#include "mir/shading/reflection_lobe.hpp"
#include "mir/shading/sampled_light.hpp"

namespace mir {

/// A Bsdf whose lobe can be sampled alone.
///
/// lobe_direction(params, n, wo, u) follows lobe_density(params, n, wi, wo), per steradian, which
/// may be asked for any `wi` and has no branches.
template <class B>
concept LobedBsdf = Bsdf<B> && has_lobe<B> &&
    requires(const typename B::Params& p, Vec3 n, Vec3 wi, Vec3 wo, Vec2 u) {
    { B::lobe_direction(p, n, wo, u) } -> std::same_as<Vec3>;
    { B::lobe_density(p, n, wi, wo) } -> std::same_as<float>;
};

/// Directions into the lobe of a glossy surface, beside as many samples of lights. The balance
/// heuristic weighs both, so that a smooth surface finds a large lamp by its lobe and a small one
/// by the lamp. The directions of luxels that share are one Kronecker sequence with a random shift.
/// Host and device. Source: Veach and Guibas, "Optimally combining sampling techniques for Monte
/// Carlo rendering", SIGGRAPH 1995.
template <LobedBsdf B>
class LobeSamples {
 public:
    /// Of a surface that has a lobe. `random` is as for the lights, whose numbers are left alone.
    MIR_HD LobeSamples(const Surface<typename B::Params>& s, SharedSamples shared,
                       const Random& random)
        : surface_(s), shared_(shared), shift_(random.at(first), random.at(first + 1)) {}

    /// Whether a surface has a lobe so narrow that it pays.
    [[nodiscard]] MIR_HD static bool are_for(const Surface<typename B::Params>& s) {
        return B::lobe(s.bsdf, s.normal, s.wo).sharpness >= least_sharpness;
    }

    /// The k-th direction, unit; maybe below the surface.
    [[nodiscard]] MIR_HD Vec3 direction(std::uint32_t k) const {
        const Vec2 u = kronecker_point(shift_, k * shared_.shares + shared_.share);
        return B::lobe_direction(surface_.bsdf, surface_.normal, surface_.wo, u);
    }

    /// How dense they are at `wi`, per steradian. No branches.
    [[nodiscard, gnu::always_inline]] MIR_HD float density(Vec3 wi) const {
        return B::lobe_density(surface_.bsdf, surface_.normal, wi, surface_.wo);
    }

 private:
    /// Seen along the normal a GGX width of 0.16. Under wider lobes directions by luminance alone
    /// leave less noise of a sky (docs/decisions/060).
    static constexpr float least_sharpness = 20.0f;
    static constexpr std::uint32_t first = 1u << 30u;  ///< dimension behind those of all lights

    Surface<typename B::Params> surface_;
    SharedSamples shared_;
    Vec2 shift_;
};

/// Where there are no LobeSamples: lights alone are sampled.
struct NoLobe {
    /// How dense directions are at any, per steradian.
    [[nodiscard, gnu::always_inline]] MIR_HD static float density(Vec3 /*wi*/) { return 0.0f; }
};

}  // namespace mir
