// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstddef>
#include <cstdint>

namespace mir {

/// Which blocks of 256 luxels have one that faces a VPL. A byte for each pair, blocks side by side,
/// since shafts ask for one VPL and neighbouring blocks. Their words would be far apart.
struct FacedBlocks {
    std::uint8_t* flags = nullptr;  ///< 1 where a luxel faces the VPL
    std::uint32_t blocks = 0;       ///< of the tile

    /// Of the k-th VPL of a batch.
    [[nodiscard]] MIR_HD std::uint8_t& at(std::uint32_t block, std::uint32_t k) const {
        return flags[std::size_t{k} * blocks + block];
    }
};

}  // namespace mir
