// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/data/blocked_layout.hpp"

namespace mir {

/// Neighbouring blocks of a tile whose luxels are put into clusters together. Up to two by two. A
/// slot is a place in memory, told by its blocked index; luxels change slots within a page alone.
struct LuxelPage {
    static constexpr std::uint32_t side = 2;  ///< of a whole page, blocks
    /// Luxels of a whole page.
    static constexpr std::uint32_t most_luxels = side * side * BlockedLayout::block_size;

    std::uint32_t first_block = 0;  ///< the upper left one
    std::uint32_t width = 0;        ///< blocks, 1 or 2
    std::uint32_t height = 0;       ///< blocks, 1 or 2
    std::uint32_t blocks_x = 0;     ///< of the tile

    /// Blocks: 1, 2 or 4.
    [[nodiscard]] MIR_HD std::uint32_t blocks() const { return width * height; }
    /// Luxels: 256, 512 or 1024.
    [[nodiscard]] MIR_HD std::uint32_t luxels() const {
        return blocks() * BlockedLayout::block_size;
    }
    /// Number in the tile of block `b` < blocks().
    [[nodiscard]] MIR_HD std::uint32_t block(std::uint32_t b) const {
        const std::uint32_t row = width == 1 ? b : b / side;
        const std::uint32_t column = width == 1 ? 0 : b % side;
        return first_block + row * blocks_x + column;
    }
    /// Blocked index of slot `k` < luxels(). Aligned runs of 256 slots are aligned in memory.
    [[nodiscard]] MIR_HD LuxelIndex slot(std::uint32_t k) const {
        return block(k / BlockedLayout::block_size) * BlockedLayout::block_size +
               k % BlockedLayout::block_size;
    }
};

/// The pages of a tile, which hold each of its blocks once.
struct LuxelPages {
    BlockedLayout layout;  ///< of the tile

    /// Pages side by side.
    [[nodiscard]] MIR_HD std::uint32_t columns() const {
        return (layout.blocks_x + LuxelPage::side - 1) / LuxelPage::side;
    }
    /// Pages of the tile.
    [[nodiscard]] MIR_HD std::uint32_t count() const {
        return columns() * ((layout.blocks_y + LuxelPage::side - 1) / LuxelPage::side);
    }
    /// Page `i` < count().
    [[nodiscard]] MIR_HD LuxelPage operator[](std::uint32_t i) const {
        const std::uint32_t x = i % columns() * LuxelPage::side;
        const std::uint32_t y = i / columns() * LuxelPage::side;
        return {y * layout.blocks_x + x, blocks_from(x, layout.blocks_x),
                blocks_from(y, layout.blocks_y), layout.blocks_x};
    }

 private:
    MIR_HD static std::uint32_t blocks_from(std::uint32_t first, std::uint32_t all) {
        return all - first < LuxelPage::side ? all - first : LuxelPage::side;
    }
};

}  // namespace mir
