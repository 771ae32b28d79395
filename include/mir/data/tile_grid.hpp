// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"

#include <cstddef>

namespace mir {

/// What cut_into_tiles() does, in closed form for kernels. The tiles of an image in row order,
/// their blocks of 16 x 16 numbered one tile after another. For fewer than 2^32 luxels.
struct TileGrid {
    Extent image;  ///< luxels
    Extent tile;   ///< of all tiles but those at the right and the lower edge; not zero

    /// The grid of tiles that cut_into_tiles(image) returned.
    static TileGrid of(Extent image, const std::vector<Tile>& tiles) {
        return {image, {tiles.front().width, tiles.front().height}};
    }

    /// Tiles side by side.
    [[nodiscard]] MIR_HD constexpr std::uint32_t columns() const {
        return parts(image.width, tile.width);
    }
    /// Tiles one below the other.
    [[nodiscard]] MIR_HD constexpr std::uint32_t rows() const {
        return parts(image.height, tile.height);
    }

    /// Tile `t` < columns() * rows(), as cut_into_tiles() returns it.
    [[nodiscard]] MIR_HD constexpr Tile operator[](TileIndex t) const {
        const std::uint32_t x = t % columns() * tile.width;
        const std::uint32_t y = t / columns() * tile.height;
        return {x, y, least(tile.width, image.width - x), least(tile.height, image.height - y)};
    }

    /// Blocks of the tiles before tile `t`; of all for the number of tiles.
    [[nodiscard]] MIR_HD constexpr std::uint32_t first_block(TileIndex t) const {
        const std::uint32_t row = t / columns();
        const std::uint32_t before = row * blocks_across() * blocks(tile.height);
        if (row == rows()) return blocks_across() * blocks_down();
        return before + t % columns() * blocks(tile.width) * blocks((*this)[t].height);
    }

    /// Tile that holds a block.
    [[nodiscard]] MIR_HD constexpr TileIndex tile_of(std::uint32_t block) const {
        const std::uint32_t per_row = blocks_across() * blocks(tile.height);
        const TileIndex first = block / per_row * columns();
        const std::uint32_t per_tile = blocks(tile.width) * blocks((*this)[first].height);
        return first + block % per_row / per_tile;
    }

    /// Blocks side by side, and one below the other, in the whole image.
    [[nodiscard]] MIR_HD constexpr std::uint32_t blocks_across() const {
        return blocks_along(image.width, tile.width);
    }
    /// Blocks one below the other in the whole image. Each row of tiles is padded by itself.
    [[nodiscard]] MIR_HD constexpr std::uint32_t blocks_down() const {
        return blocks_along(image.height, tile.height);
    }

    /// Luxels in memory, padding included.
    [[nodiscard]] constexpr std::uint64_t size() const {
        return std::uint64_t{blocks_across()} * blocks_down() * BlockedLayout::block_size;
    }

    /// Same image, same tiles.
    friend constexpr bool operator==(const TileGrid&, const TileGrid&) = default;

 private:
    MIR_HD static constexpr std::uint32_t least(std::uint32_t a, std::uint32_t b) {
        return a < b ? a : b;
    }
    MIR_HD static constexpr std::uint32_t parts(std::uint32_t whole, std::uint32_t part) {
        return whole / part + (whole % part != 0 ? 1 : 0);
    }
    MIR_HD static constexpr std::uint32_t blocks(std::uint32_t luxels) {
        return parts(luxels, BlockedLayout::side);
    }
    MIR_HD static constexpr std::uint32_t blocks_along(std::uint32_t image, std::uint32_t tile) {
        return image / tile * blocks(tile) + blocks(image % tile);
    }
};

}  // namespace mir
