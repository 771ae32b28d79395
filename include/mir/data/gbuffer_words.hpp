// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"
#include "mir/data/tile_grid.hpp"

namespace mir {

/// The memory of a G-buffer as kernels write it: per tile a run of hit words, then one of surface
/// words, as in BlockedGBuffer. A view; stores to different luxels may happen at the same time.
template <class Params>
struct GBufferWords {
    using Surface = mir::Surface<Params>;
    static constexpr std::size_t per_luxel = SoaView<Hit>::words + SoaView<Surface>::words;

    std::uint32_t* words = nullptr;
    TileGrid tiles;

    [[nodiscard]] MIR_HD SoaView<Hit> hits(TileIndex t) const {
        return {words + first_word(tiles, t), luxels(t)};
    }
    [[nodiscard]] MIR_HD SoaView<Surface> surfaces(TileIndex t) const {
        return {hits(t).planes + std::size_t{luxels(t)} * SoaView<Hit>::words, luxels(t)};
    }

    /// Words of all tiles.
    static constexpr std::uint64_t count(const TileGrid& tiles) { return tiles.size() * per_luxel; }
    /// Place of a tile's first word.
    MIR_HD static constexpr std::size_t first_word(const TileGrid& tiles, TileIndex t) {
        return std::size_t{tiles.first_block(t)} * BlockedLayout::block_size * per_luxel;
    }

 private:
    [[nodiscard]] MIR_HD std::uint32_t luxels(TileIndex t) const {
        return BlockedLayout::of(tiles[t]).size();
    }
};

}  // namespace mir
