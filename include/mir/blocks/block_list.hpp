// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"

#include <vector>

namespace mir::blocks {

/// One 16x16 block of a submitted tile: the grain of parallel work on the host. Tiles may be as
/// small as one block and still fill every core.
struct Block {
    TileIndex tile = 0;
    std::uint32_t block = 0;
};

/// Blocked index of the block's first luxel in its tile.
constexpr LuxelIndex first_luxel(Block b) { return b.block * BlockedLayout::block_size; }

/// Appends the blocks of a tile.
inline void append_blocks(std::vector<Block>& blocks, TileIndex index, const Tile& tile) {
    for (std::uint32_t b = 0; b < BlockedLayout::of(tile).blocks(); ++b)
        blocks.push_back({index, b});
}

}  // namespace mir::blocks
