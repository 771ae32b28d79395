// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"
#include "mir/concepts/visibility.hpp"

namespace mir {

/// True when luxel and VPL lie above each other's geometric tangent plane. False costs no ray.
MIR_HD inline bool faces(const Hit& hit, const Vpl& vpl) {
    const Vec3 d = vpl.position - hit.position;
    return glm::dot(d, hit.normal) > 0.0f && glm::dot(d, vpl.normal) < 0.0f;
}

/// contribution() if nothing lies between luxel and VPL, W m^-2 sr^-1.
template <Shading F>
MIR_HD Rgb unshadowed(const Hit& hit, const typename F::Surface& surface, const Vpl& vpl,
                      const F& shade) {
    return faces(hit, vpl) ? shade(hit, surface, vpl) : Rgb{};
}

/// Radiance that one VPL sends to the viewer through one luxel, W m^-2 sr^-1. It is the inner body
/// of algorithm 3 of the paper.
template <Visibility V, Shading F>
MIR_HD Rgb contribution(const Hit& hit, const typename F::Surface& surface, const Vpl& vpl,
                        const V& visibility, const F& shade) {
    const Rgb shaded = unshadowed(hit, surface, vpl, shade);
    if (is_black(shaded)) return {};
    return visibility.visible(vpl.position, hit.position) ? shaded : Rgb{};
}

}  // namespace mir
