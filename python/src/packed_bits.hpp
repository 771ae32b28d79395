// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/known_visibility.hpp"
#include "mir/data/blocked_layout.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mirpy {

/// Bytes of a row of bits, eight in each, the lowest first.
inline std::size_t bytes_of_row(std::size_t bits) { return (bits + 7) / 8; }

/// Bits of visibility(), a row for each luxel in row order, as schedulers ask for them. Model of
/// mir::KnownVisibility; what it points to must outlive it.
struct PackedBits {
    static constexpr mir::Space space = mir::Space::host;

    const std::uint8_t* rows;
    std::size_t row_bytes;
    std::uint32_t width;  ///< luxels of the image across
    const mir::Tile* tiles;

    [[nodiscard]] bool sees(mir::TileIndex t, mir::LuxelIndex i, mir::VplIndex j) const {
        const mir::Tile tile = tiles[t];
        const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
        if (at.x >= tile.width || at.y >= tile.height) return false;
        const std::size_t luxel = std::size_t{tile.y + at.y} * width + tile.x + at.x;
        return (rows[luxel * row_bytes + j / 8] >> (j % 8) & 1u) != 0;
    }
    /// Of schedulers that shade whole blocks: these bits lie otherwise.
    [[nodiscard]] const std::uint16_t* block_masks(mir::TileIndex, std::uint32_t,
                                                   mir::VplIndex) const {
        return nullptr;
    }
};
static_assert(mir::KnownVisibility<PackedBits>);

}  // namespace mirpy
