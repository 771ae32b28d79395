// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mir {

namespace detail {

/// What GGX lobes reflect of light from everywhere, by alpha. It is f0 GgxShares::f0 + f90
/// GgxShares::f90: light that microfacets would scatter twice is lost.
struct GgxShares {
    double f0 = 0.0;
    double f90 = 0.0;
};

/// By 4096 points of a Kronecker sequence. The viewer's angle, spread by the cosine, and the
/// direction. Source: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
inline GgxShares ggx_shares(float alpha) {
    constexpr std::uint32_t points = 4096;
    const auto coordinate = [](std::uint32_t i, double step) {
        const double place = 0.5 + i * step;
        return static_cast<float>(place - std::floor(place));
    };
    const Vec3 n(0.0f, 0.0f, 1.0f);
    const CookTorrance::Params normal{{}, {1.0f, 1.0f, 1.0f}, 0.0f, alpha};
    const CookTorrance::Params grazing{{}, {}, 1.0f, alpha};
    GgxShares sum;
    for (std::uint32_t i = 0; i < points; ++i) {
        const float cos2 = coordinate(i, 0.8191725133961645);
        const Vec2 u(coordinate(i, 0.6710436067037893), coordinate(i, 0.5497004779019703));
        const Vec3 wo(std::sqrt(1.0f - cos2), 0.0f, std::sqrt(cos2));
        sum.f0 += static_cast<double>(CookTorrance::sample(normal, n, wo, u, 0.0f).weight.r);
        sum.f90 += static_cast<double>(CookTorrance::sample(grazing, n, wo, u, 0.0f).weight.r);
    }
    return {sum.f0 / points, sum.f90 / points};
}

/// The same from a table over the roughness, the root of alpha.
inline GgxShares tabulated_ggx_shares(float alpha) {
    constexpr std::size_t steps = 32;
    static const std::array<GgxShares, steps + 1> table = [] {
        std::array<GgxShares, steps + 1> made;
        for (std::size_t i = 0; i <= steps; ++i) {
            const float roughness = static_cast<float>(i) / static_cast<float>(steps);
            made[i] = ggx_shares(larger(roughness * roughness, min_ggx_alpha));
        }
        return made;
    }();
    const float place = std::sqrt(smaller(alpha, 1.0f)) * static_cast<float>(steps);
    const std::size_t i = std::min(static_cast<std::size_t>(place), steps - 1);
    const double t = static_cast<double>(place) - static_cast<double>(i);
    return {table[i].f0 + t * (table[i + 1].f0 - table[i].f0),
            table[i].f90 + t * (table[i + 1].f90 - table[i].f90)};
}

}  // namespace detail

/// Share of light from all directions alike that a surface sends back, 0..1. The reflectance of the
/// Lambertian surface that has its power. The integral of f cos cos over both hemispheres, over pi.
/// Thread-safe.
inline Rgb mean_reflectance(const Lambert::Params& p) { return p.reflectance; }

/// The same within 0.003: the base exactly, the interface from a table over its roughness.
inline Rgb mean_reflectance(const CookTorrance::Params& p) {
    const detail::GgxShares ggx = detail::tabulated_ggx_shares(p.alpha);
    const auto channel = [&](float base, float f0) {
        const float mean = f0 + (p.f90 - f0) / 21.0f;
        const double of_interface =
            ggx.f0 * static_cast<double>(f0) + ggx.f90 * static_cast<double>(p.f90);
        return smaller(base * (1.0f - mean) * (1.0f - mean) + static_cast<float>(of_interface),
                       1.0f);
    };
    return {channel(p.diffuse.r, p.f0.r), channel(p.diffuse.g, p.f0.g),
            channel(p.diffuse.b, p.f0.b)};
}

}  // namespace mir
