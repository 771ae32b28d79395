// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"
#include "mir/data/tile_grid.hpp"

namespace mir {

/// The memory of a G-buffer as kernels write it. Per tile a run of hit words, then one of surface
/// words, as in BlockedGBuffer. A view; stores to different luxels may happen at the same time.
template <class Params>
struct GBufferWords {
    using Surface = mir::Surface<Params>;  ///< what a luxel tells shading
    /// Words of a hit and a surface together.
    static constexpr std::size_t per_luxel = SoaView<Hit>::words + SoaView<Surface>::words;

    std::uint32_t* words = nullptr;  ///< count(tiles) of them, where the kernel runs
    TileGrid tiles;                  ///< of the image or band

    /// Hits of tile `t`, padding included.
    [[nodiscard]] MIR_HD SoaView<Hit> hits(TileIndex t) const {
        return {words + first_word(tiles, t), luxels(t)};
    }
    /// Surfaces of tile `t`, padding included.
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

/// The same memory as kernels read it by places in the image. A view; thread-safe.
template <class Params>
struct LuxelImageView {
    using Surface = mir::Surface<Params>;  ///< what a luxel tells shading

    const std::uint32_t* words = nullptr;  ///< as GBufferWords::words
    TileGrid tiles;                        ///< of the image or band

    /// Of the luxel in column x and row y of the image. It must lie in it.
    [[nodiscard]] MIR_HD Hit hit(std::uint32_t x, std::uint32_t y) const {
        const TileIndex t = tile(x, y);
        return hits(t).load(index(t, x, y));
    }
    /// The same of its surface.
    [[nodiscard]] MIR_HD Surface surface(std::uint32_t x, std::uint32_t y) const {
        const TileIndex t = tile(x, y);
        const SoaView<const Hit> before = hits(t);
        const SoaView<const Surface> surfaces{
            before.planes + std::size_t{before.stride} * SoaView<Hit>::words, before.stride};
        return surfaces.load(index(t, x, y));
    }

 private:
    [[nodiscard]] MIR_HD TileIndex tile(std::uint32_t x, std::uint32_t y) const {
        return y / tiles.tile.height * tiles.columns() + x / tiles.tile.width;
    }
    [[nodiscard]] MIR_HD SoaView<const Hit> hits(TileIndex t) const {
        return {words + GBufferWords<Params>::first_word(tiles, t),
                BlockedLayout::of(tiles[t]).size()};
    }
    [[nodiscard]] MIR_HD LuxelIndex index(TileIndex t, std::uint32_t x, std::uint32_t y) const {
        const Tile tile = tiles[t];
        return BlockedLayout::of(tile)(x - tile.x, y - tile.y);
    }
};

}  // namespace mir
