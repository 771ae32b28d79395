// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"
#include "mir/shading/vsl_shading.hpp"
#include "mir/sum_seen.hpp"

namespace mir {

/// Light of virtual spherical lights: radiance towards the viewer of every luxel, W m^-2 sr^-1.
/// `matrix` says who sees which VPL, `radii` are those of the spheres, `shading` gives the rest,
/// its radius apart. Bits as of sum_seen().
/// @throws Error(invalid_argument) when the matrix belongs to other tiles or VPLs, or the radii do.
template <Bsdf B, TiledGBuffer G, Executor E>
Image<Rgb> vsl_light(const G& gbuffer, const VisibilityMatrix& matrix, VplSpan<Space::host> vpls,
                     std::span<const float> radii, VslShading<B> shading, E& executor) {
    expects(radii.size() == vpls.size(),
            "spheres were given radii of other VPLs (each needs one); give as many as there are "
            "VPLs");
    const auto reflects = [&](const auto& surface) { return shading.reflects(surface); };
    return sum_seen(
        gbuffer, matrix, vpls.size(), reflects,
        [&](const Hit& hit, const auto& surface, VplIndex j) {
            if (is_black(vpls[j].intensity)) return Rgb{};
            VslShading<B> shade = shading;
            shade.radius = radii[j];
            return shade(hit, surface, vpls[j]);
        },
        executor);
}

}  // namespace mir
