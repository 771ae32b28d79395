// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/image.hpp"
#include "mir/kernels/luxel_light.hpp"

namespace mir {

/// Direct light by next-event estimation: radiance towards the viewer of every luxel,
/// W m^-2 sr^-1. `samples` points on emissive triangles per luxel, chosen by power; point, spot
/// and directional lights are summed exactly. Unbiased. Emission is not included.
template <Bsdf B, TiledGBuffer G, Visibility V, Executor E>
Image<Rgb> direct_light(const G& gbuffer, const LightTable& lights, const V& visibility,
                        LuxelBand band, std::uint32_t samples, E& executor) {
    Image<Rgb> image(gbuffer.extent());
    const LuxelLight<B, V> light{{lights, visibility, samples}, {lights, visibility}, band};
    std::vector<std::pair<TileIndex, std::uint32_t>> rows;
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t)
        for (std::uint32_t y = 0; y < gbuffer.tiles()[t].height; ++y) rows.emplace_back(t, y);

    executor.for_each(rows.size(), [&](std::size_t i) {
        const auto [t, y] = rows[i];
        const Tile tile = gbuffer.tiles()[t];
        const auto luxels = gbuffer.view(t);
        const auto layout = BlockedLayout::of(tile);
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            const Hit hit = luxels.hit(layout(x, y));
            if (is_empty(hit)) continue;
            image(tile.x + x, tile.y + y) =
                light(hit, luxels.surface(layout(x, y)), tile.x + x, tile.y + y);
        }
    });
    return image;
}

}  // namespace mir
