// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/hd.hpp"
#include "mir/data/extent.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mir {

using LuxelIndex = std::uint32_t;  ///< blocked index inside one tile
using VplIndex = std::uint32_t;    ///< place in a set of VPLs
using TileIndex = std::uint32_t;   ///< place in what cut_into_tiles() returned

/// Rectangle of luxels: the unit of scheduling and of transfer (section 5.1 of the paper).
struct Tile {
    std::uint32_t x = 0;       ///< first column, of the image that was cut
    std::uint32_t y = 0;       ///< first row
    std::uint32_t width = 0;   ///< columns, at least 1
    std::uint32_t height = 0;  ///< rows, at least 1
};

/// Cuts `image` into tiles of `size` in row order. The last column and row may be smaller.
/// @throws Error(invalid_argument) when an extent is zero.
inline std::vector<Tile> cut_into_tiles(Extent image, Extent size) {
    expects(size.width > 0 && size.height > 0,
            "a tile of zero luxels was asked for (a tile must hold at least one); use 256x256");
    expects(image.width > 0 && image.height > 0,
            "an image of zero luxels was asked for (there is nothing to compute); give both a "
            "width and a height");
    std::vector<Tile> tiles;
    for (std::uint32_t y = 0; y < image.height; y += size.height)
        for (std::uint32_t x = 0; x < image.width; x += size.width)
            tiles.push_back({x, y, std::min(size.width, image.width - x),
                             std::min(size.height, image.height - y)});
    return tiles;
}

/// Tiles in one row of what cut_into_tiles() returned.
inline std::uint32_t tiles_per_row(const std::vector<Tile>& tiles) {
    std::uint32_t n = 0;
    while (n < tiles.size() && tiles[n].y == 0) ++n;
    return n;
}

/// Tile of what cut_into_tiles() returned that holds luxel (x, y).
inline TileIndex tile_holding(const std::vector<Tile>& tiles, std::uint32_t per_row,
                              std::uint32_t x, std::uint32_t y) {
    const Tile& first = tiles.front();
    return (y / first.height) * per_row + x / first.width;
}

}  // namespace mir
