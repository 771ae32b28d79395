// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"
#include "mir/data/luxel.hpp"

namespace mir {

/// Light of a luxel by its blocked index in a tile: light(hit, surface, x, y), the place in the
/// band that the tile is part of. Black for padding and where nothing is seen. For kernels over
/// luxels.
template <class G, class Light>
[[nodiscard]] MIR_HD Rgb light_of_luxel(const G& luxels, const Tile& tile, LuxelIndex i,
                                        const Light& light) {
    const LuxelPlace at = BlockedLayout::of(tile).place(i);
    if (at.x >= tile.width || at.y >= tile.height) return {};
    const Hit hit = luxels.hit(i);
    if (is_empty(hit)) return {};
    return light(hit, luxels.surface(i), tile.x + at.x, tile.y + at.y);
}

}  // namespace mir
