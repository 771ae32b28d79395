// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/data/image.hpp"
#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/kernels/sky_passes.hpp"
#include "mir/shading/direct_samples.hpp"

#include <vector>

namespace mir {

/// Where each block of a tile sees the environment, by SkyTryPass and SkyGuidePass.
template <class G, Visibility V, Executor E>
std::vector<SkyGuide> sky_guides(const G& luxels, Tile tile, const LuxelBand& band,
                                 const SkyTries<V>& tries, E& executor) {
    const std::uint32_t blocks = BlockedLayout::of(tile).blocks();
    std::vector<SkyTried> tried(std::size_t{blocks} * sky_sets);
    std::vector<SkyGuide> guides(blocks);
    executor.for_each(blocks, [&](std::size_t b) {
        const auto block = static_cast<std::uint32_t>(b);
        for (std::uint32_t set = 0; set < sky_sets; ++set) {
            const SkyTryPass pass{luxels, tile, band, tries, set, tried.data()};
            for (std::uint32_t k = 0; k < SkyTried::side; ++k) pass(block * SkyTried::side + k);
        }
        SkyGuidePass{tried.data(), blocks, guides.data()}(block);
    });
    return guides;
}

/// Direct light by next-event estimation: radiance towards the viewer of every luxel,
/// W m^-2 sr^-1. `samples` per luxel: points on emissive triangles, which a LightTree chooses, and
/// directions towards the environment, which a SkyGuide leads through windows. Directional lights
/// are summed exactly, and so are point and spot lights up to LightTable::most_summed; more of them
/// join the tree. Unbiased. Emission is not included.
template <Bsdf B, TiledGBuffer G, Visibility V, Executor E>
Image<Rgb> direct_light(const G& gbuffer, const LightTable& lights, const V& visibility,
                        LuxelBand band, DirectSamples samples, E& executor) {
    Image<Rgb> image(gbuffer.extent());
    const LuxelLight<B, V> light(lights, visibility, samples, band);
    const bool guides = samples.want_sky_guide() && !lights.environment().empty();
    std::vector<std::vector<SkyGuide>> skies(gbuffer.tiles().size());
    for (TileIndex t = 0; guides && t < skies.size(); ++t)
        skies[t] = sky_guides(gbuffer.view(t), gbuffer.tiles()[t], band,
                              SkyTries<V>(lights.view(), visibility), executor);
    for_each_luxel_of_tiles(
        gbuffer, executor,
        [&](TileIndex t, std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
            const Hit hit = luxels.hit(i);
            const SkyGuide* const sky = guides ? sky_of(skies[t].data(), i) : nullptr;
            if (!is_empty(hit)) image(x, y) = light(hit, luxels.surface(i), x, y, sky);
        });
    return image;
}

}  // namespace mir
