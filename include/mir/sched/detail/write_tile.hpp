// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"
#include "mir/data/image.hpp"

namespace mir::sched::detail {

/// Writes the luxels of a tile to the image row by row. radiance(i) is that of blocked index i.
template <class T, class Radiance>
void write_tile(Image<T>& image, Tile tile, const Radiance& radiance) {
    const auto layout = BlockedLayout::of(tile);
    for (std::uint32_t y = 0; y < tile.height; ++y)
        for (std::uint32_t x = 0; x < tile.width; ++x)
            image(tile.x + x, tile.y + y) = radiance(layout(x, y));
}

}  // namespace mir::sched::detail
