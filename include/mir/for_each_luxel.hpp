// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/data/blocked_layout.hpp"

#include <utility>
#include <vector>

namespace mir {

/// for_each_luxel() whose body(t, x, y, luxels, i) is told the tile, too.
template <TiledGBuffer G, Executor E, class Body>
void for_each_luxel_of_tiles(const G& gbuffer, E& executor, const Body& body) {
    std::vector<std::pair<TileIndex, std::uint32_t>> rows;
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t)
        for (std::uint32_t y = 0; y < gbuffer.tiles()[t].height; ++y) rows.emplace_back(t, y);

    executor.for_each(rows.size(), [&](std::size_t r) {
        const auto [t, y] = rows[r];
        const Tile tile = gbuffer.tiles()[t];
        const auto luxels = gbuffer.view(t);
        const auto layout = BlockedLayout::of(tile);
        for (std::uint32_t x = 0; x < tile.width; ++x)
            body(t, tile.x + x, tile.y + y, luxels, layout(x, y));
    });
}

/// Calls body(x, y, luxels, i) for every luxel of a G-buffer, rows in parallel. (x, y) is its place
/// in the G-buffer's extent, `luxels` the GBuffer of its tile and i its index there. Padding is
/// left out, empty luxels are not.
template <TiledGBuffer G, Executor E, class Body>
void for_each_luxel(const G& gbuffer, E& executor, const Body& body) {
    for_each_luxel_of_tiles(gbuffer, executor,
                            [&](TileIndex, std::uint32_t x, std::uint32_t y, const auto& luxels,
                                LuxelIndex i) { body(x, y, luxels, i); });
}

}  // namespace mir
