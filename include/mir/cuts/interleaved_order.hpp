// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstdint>

namespace mir {

/// The order of a block's 256 luxels while they gather cuts. Each group has one luxel of each of
/// the block's sixteen squares of 4 x 4, and another place in each square. Groups pick other VPLs,
/// so neighbours do, and what a group has in common shows no lattice.
struct InterleavedOrder {
    static constexpr std::uint32_t groups = 16;      ///< of a block
    static constexpr std::uint32_t group_size = 16;  ///< luxels of a group, squares of a block

    /// Place in the block of luxel `k` of group `s`, for k in square k.
    [[nodiscard]] MIR_HD static constexpr std::uint32_t place_of(std::uint32_t s, std::uint32_t k) {
        return k * group_size + (s ^ shift(k));
    }
    /// Place in this order of luxel `i` of the block.
    [[nodiscard]] MIR_HD static constexpr std::uint32_t place_here(std::uint32_t i) {
        const std::uint32_t square = i / group_size;
        return (i % group_size ^ shift(square)) * group_size + square;
    }

 private:
    /// Sixteen shifts, each once; those of neighbours differ in both directions. A shift keeps
    /// luxels of a square of 2 x 2 together.
    MIR_HD static constexpr std::uint32_t shift(std::uint32_t square) {
        constexpr std::uint64_t shifts = 0x2F58'94E3'7A0D'C1B6;  // the first in the lowest bits
        return static_cast<std::uint32_t>(shifts >> 4 * square) & 15u;
    }
};

}  // namespace mir
