// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/data/image.hpp"
#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/shading/direct_samples.hpp"

namespace mir {

/// Direct light by next-event estimation: radiance towards the viewer of every luxel,
/// W m^-2 sr^-1. `samples` per luxel: points on emissive triangles, which a LightTree chooses, and
/// directions towards the environment. Directional lights are summed exactly, and so are point and
/// spot lights up to LightTable::most_summed; more of them join the tree. Unbiased. Emission is not
/// included.
template <Bsdf B, TiledGBuffer G, Visibility V, Executor E>
Image<Rgb> direct_light(const G& gbuffer, const LightTable& lights, const V& visibility,
                        LuxelBand band, DirectSamples samples, E& executor) {
    Image<Rgb> image(gbuffer.extent());
    const LuxelLight<B, V> light(lights, visibility, samples, band);
    for_each_luxel(gbuffer, executor,
                   [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                       const Hit hit = luxels.hit(i);
                       if (!is_empty(hit)) image(x, y) = light(hit, luxels.surface(i), x, y);
                   });
    return image;
}

}  // namespace mir
