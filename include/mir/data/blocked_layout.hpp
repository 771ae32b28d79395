// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/tile.hpp"

namespace mir {

/// Column and row of a luxel in its tile.
struct LuxelPlace {
    std::uint32_t x = 0;  ///< column, 0 at the left
    std::uint32_t y = 0;  ///< row, 0 at the top
};

/// Order of the luxels of one tile in memory (figure 4 of the paper). Squares of 16x16 follow one
/// another, each cut into 8x4 and those into 4x4: 16 or 32 consecutive luxels (a vector register, a
/// warp) are neighbours in both directions. The blocked index of a luxel is the global index of its
/// CUDA thread. Ragged edges are padded to whole blocks.
struct BlockedLayout {
    static constexpr std::uint32_t side = 16;                 ///< of a block, luxels
    static constexpr std::uint32_t block_size = side * side;  ///< luxels of a block

    std::uint32_t blocks_x = 0;  ///< blocks side by side, ragged ones included
    std::uint32_t blocks_y = 0;  ///< blocks one below the other

    /// The layout of a tile of such a size, wherever it lies in the image.
    MIR_HD static constexpr BlockedLayout of(Tile t) {
        return {(t.width + side - 1) / side, (t.height + side - 1) / side};
    }
    /// Blocks of the tile.
    [[nodiscard]] MIR_HD constexpr std::uint32_t blocks() const { return blocks_x * blocks_y; }
    /// Luxels of the tile in memory, padding included; blocked indices are below it.
    [[nodiscard]] MIR_HD constexpr std::uint32_t size() const { return blocks() * block_size; }

    /// Blocked index of the luxel at (x, y) of the tile.
    [[nodiscard]] MIR_HD constexpr LuxelIndex operator()(std::uint32_t x, std::uint32_t y) const {
        const std::uint32_t block = (y / side) * blocks_x + x / side;
        return block * block_size + inside(x % side, y % side);
    }

    /// Index inside a block of the luxel at (x, y), both below `side`.
    [[nodiscard]] MIR_HD static constexpr LuxelIndex inside(std::uint32_t x, std::uint32_t y) {
        return (y / 4) * 64 + (x / 4) * 16 + (y % 4) * 4 + x % 4;
    }

    /// The luxel of a blocked index; outside of ragged tiles for luxels of the padding.
    [[nodiscard]] MIR_HD constexpr LuxelPlace place(LuxelIndex i) const {
        const std::uint32_t block = i / block_size;
        const std::uint32_t x = i / 16 % 4 * 4 + i % 4;
        const std::uint32_t y = i / 64 % 4 * 4 + i / 4 % 4;
        return {block % blocks_x * side + x, block / blocks_x * side + y};
    }

    /// The part of tile `t` that block `block` covers; empty extents never occur.
    [[nodiscard]] constexpr Tile block_area(Tile t, std::uint32_t block) const {
        const std::uint32_t x = (block % blocks_x) * side;
        const std::uint32_t y = (block / blocks_x) * side;
        return {x, y, std::min(side, t.width - x), std::min(side, t.height - y)};
    }
};

/// `size` rounded up to whole blocks. Tiles of such sizes cut an image into the same blocks, so
/// that ray packets, and with them the answers of engines that decide ties by packet, do not depend
/// on the tile size.
constexpr Extent whole_blocks(Extent size) {
    const auto round_up = [](std::uint32_t n) {
        constexpr std::uint32_t mask = BlockedLayout::side - 1;
        return n > ~mask ? ~mask : (n + mask) & ~mask;
    };
    return {round_up(size.width), round_up(size.height)};
}

}  // namespace mir
