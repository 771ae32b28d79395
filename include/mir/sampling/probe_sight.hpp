// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/image_probe.hpp"

#include <algorithm>
#include <optional>

namespace mir {

/// How a place looks from the luxels of a probe.
struct ProbeSight {
    Rgb response;          ///< what a VPL of 1 W sr^-1 there gives to the image, sr^-1 m^-2
    double density = 0.0;  ///< of a ray drawn by ray_from_probe() meeting the place, m^-2
    bool is_seen = false;  ///< from the luxel that was asked about
};

/// A ray drawn by ray_from_probe().
struct ProbeRay {
    static constexpr std::uint32_t none = ~0u;  ///< no luxel

    Ray ray;                     ///< leaves the luxel
    std::uint32_t luxel = none;  ///< index of ImageProbe::hit()
    float passed = 1.0f;         ///< chance with which it passed what it passed
};

/// Response and density at once, from the same shadow rays. The density is the marginal over all
/// luxels: it holds whichever of them the ray was drawn from. `luxel` is asked whether it sees the
/// place.
template <Bsdf B, Visibility V>
ProbeSight sight_of(const ImageProbe<B, V>& probe, const Vpl& place,
                    std::uint32_t luxel = ProbeRay::none) {
    double r = 0.0;
    double g = 0.0;
    double b = 0.0;
    ProbeSight sight;
    const Hit* asked = luxel == ProbeRay::none ? nullptr : &probe.hit(luxel);
    probe.for_each_lit(place, [&](const Hit& hit, const auto& surface, Rgb radiance) {
        r += radiance.r;
        g += radiance.g;
        b += radiance.b;
        sight.is_seen = sight.is_seen || &hit == asked;
        const Vec3 d = place.position - hit.position;
        const float d2 = length_squared(d);
        const Vec3 w = d * (1.0f / std::sqrt(d2));
        sight.density += static_cast<double>(B::pdf(surface.bsdf, surface.normal, w, surface.wo)) *
                         static_cast<double>(-glm::dot(w, place.normal)) / static_cast<double>(d2);
    });
    const double share = 1.0 / probe.luxels();
    sight.response = {static_cast<float>(r * share), static_cast<float>(g * share),
                      static_cast<float>(b * share)};
    if (probe.receivers() > 0) sight.density /= probe.receivers();
    return sight;
}

/// Ray from one of the probe's luxels, equally likely, drawn by what it reflects. Reversed, a way
/// for light to reach the image. Nothing when the direction runs into the surface, or no luxel
/// reflects. `pick` and `lobe` are in [0, 1), `uv` in the unit square.
template <Bsdf B, Visibility V>
std::optional<ProbeRay> ray_from_probe(const ImageProbe<B, V>& probe, float pick, Vec2 uv,
                                       float lobe) {
    const std::uint32_t n = probe.receivers();
    if (n == 0) return std::nullopt;
    const std::uint32_t i =
        std::min(static_cast<std::uint32_t>(pick * static_cast<float>(n)), n - 1);
    const auto& s = probe.surface(i);
    const Hit& hit = probe.hit(i);
    const Vec3 w = B::sample(s.bsdf, s.normal, s.wo, uv, lobe).wi;
    if (!(glm::dot(w, hit.normal) > 0.0f)) return std::nullopt;
    return ProbeRay{{hit.position, w}, i};
}

}  // namespace mir
