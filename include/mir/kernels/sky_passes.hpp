// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/luxel_light.hpp"
#include "mir/shading/sky_tries.hpp"

#include <cstddef>
#include <cstdint>

namespace mir {

/// Sets of tries of a block, by sixteen luxels each. One for blocks that see much of the sky.
inline constexpr std::uint32_t sky_sets = 4;

/// One set of the tries of sixteen luxels of each block. Kernel over the blocks of a tile times
/// sixteen. Set 0 comes first.
template <class G, Visibility V>
struct SkyTryPass {
    G luxels;           ///< of the tile
    Tile tile;          ///< in the band
    LuxelBand band;     ///< of the tile
    SkyTries<V> tries;  ///< rays
    std::uint32_t set;  ///< below sky_sets
    SkyTried* tried;    ///< set after set, of all blocks of the tile

    /// Luxel i % 16 of block i / 16.
    MIR_HD void operator()(std::uint32_t i) const {
        const BlockedLayout layout = BlockedLayout::of(tile);
        const std::uint32_t block = i / SkyTried::side;
        const std::uint32_t k = i % SkyTried::side;
        std::uint16_t& seen = tried[std::size_t{set} * layout.blocks() + block].seen[k];
        seen = 0;
        if (set > 0 && tried[block].is_open()) return;
        // The others stand for those that are empty.
        for (std::uint32_t n = 0; n < BlockedLayout::block_size; ++n) {
            const LuxelIndex l = block * BlockedLayout::block_size +
                                 (k * 16 + (k * 7 + set * 5) % 16 + n) % BlockedLayout::block_size;
            const Hit hit = luxels.hit(l);
            if (is_empty(hit)) continue;
            const LuxelPlace at = layout.place(l);
            seen =
                tries(hit, k, set, band.luxel_numbers(tile.x + at.x, tile.y + at.y, Stream::sky));
            return;
        }
    }
};
template <class G, Visibility V>
SkyTryPass(G, Tile, LuxelBand, SkyTries<V>, std::uint32_t, SkyTried*) -> SkyTryPass<G, V>;

/// Makes the guide of each block of its tries. Kernel over the blocks of a tile.
struct SkyGuidePass {
    const SkyTried* tried;  ///< of SkyTryPass
    std::uint32_t blocks;   ///< of the tile
    SkyGuide* guides;       ///< of each block

    /// Block i.
    MIR_HD void operator()(std::uint32_t i) const {
        guides[i] = SkyGuide(tried + i, blocks, tried[i].is_open() ? 1 : sky_sets);
    }
};

}  // namespace mir
