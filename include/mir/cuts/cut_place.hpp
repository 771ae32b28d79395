// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/data/blocked_layout.hpp"

namespace mir {

/// Where a G-buffer's luxels lie in the image, and the numbers they pick with.
struct CutPlace {
    std::uint64_t seed = 0;       ///< of the picks
    std::uint32_t first_row = 0;  ///< of luxels, in the image; a multiple of 16

    /// The numbers of the block whose first luxel is at (x, y) of the G-buffer.
    [[nodiscard]] MIR_HD Random numbers(std::uint32_t x, std::uint32_t y) const {
        constexpr std::uint32_t side = BlockedLayout::side;
        return {seed, Stream::cut, std::uint64_t{(first_row + y) / side} << 32 | x / side};
    }
};

}  // namespace mir
