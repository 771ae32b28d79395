// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"

namespace mir {

/// Directions into which a surface reflects most, roughly. Density (1 + 2 k) / (4 pi (1 + k x)^2)
/// per steradian, x = 1 - cos of the angle to the axis. A value.
struct ReflectionLobe {
    static constexpr float largest_sharpness = 16384.0f;  ///< narrower lobes count as this one

    Vec3 axis{0, 0, 1};      ///< unit
    float sharpness = 0.0f;  ///< k, to largest_sharpness; 0: there is no lobe
};

/// True of a BSDF that tells its lobe, `B::lobe(params, n, wo)`.
template <Bsdf B>
inline constexpr bool has_lobe = requires(const typename B::Params& p, Vec3 n, Vec3 wo) {
    { B::lobe(p, n, wo) } -> std::same_as<ReflectionLobe>;
};

/// The lobe of a BSDF that has one; none of others.
template <Bsdf B>
[[nodiscard]] MIR_HD ReflectionLobe reflection_lobe(const typename B::Params& p, Vec3 n, Vec3 wo) {
    if constexpr (has_lobe<B>)
        return B::lobe(p, n, wo);
    else
        return {};
}

}  // namespace mir
