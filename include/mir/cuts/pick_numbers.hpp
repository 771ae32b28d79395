// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"

namespace mir {

/// The numbers by which the groups of a block pick VPLs of the nodes of its cut. Numbers of one
/// node are stratified over the groups: neighbouring luxels, and those of a pixel before all, pick
/// from parts of the node that lie far apart, so that their mean is better than that of independent
/// picks. Each number alone is uniform. The cut may have 2^31 nodes, a block has 16 groups.
struct PickNumbers {
    static constexpr std::uint32_t nodes_per_block = 32;    ///< that share random bits, 4 each
    static constexpr std::uint32_t first_shift = 1u << 31;  ///< Random::block() of the shifts

    /// Random::block() of the bits that node `i` has for itself and a group.
    [[nodiscard]] MIR_HD static constexpr std::uint32_t words_of(std::uint32_t i,
                                                                 std::uint32_t group) {
        return i / 4 * 16 + group;
    }

    /// The number of node `i` for a group, a fraction of 2^64. `words` are the bits of words_of(),
    /// `shifts` those of first_shift + i / nodes_per_block.
    [[nodiscard]] MIR_HD static std::uint64_t number(std::uint32_t i, std::uint32_t group,
                                                     const Bits128& words, const Bits128& shifts) {
        const std::uint32_t shift = word(shifts, i % nodes_per_block / 8) >> i % 8 * 4 & 15u;
        return std::uint64_t{stratum(group) ^ shift} << 60 | std::uint64_t{word(words, i % 4)}
                                                                 << 28;
    }
    /// The same, from the numbers of the block.
    [[nodiscard]] MIR_HD static std::uint64_t number(std::uint32_t i, std::uint32_t group,
                                                     const Random& numbers) {
        return number(i, group, numbers.block(words_of(i, group)),
                      numbers.block(first_shift + i / nodes_per_block));
    }

    /// Sixteenth of a node from which a group picks, before the digital shift. Groups are the
    /// places in squares of 4 x 4 luxels: those of each square of 2 x 2 get a quarter each.
    [[nodiscard]] MIR_HD static constexpr std::uint32_t stratum(std::uint32_t group) {
        const std::uint32_t x = group % 4;
        const std::uint32_t y = group / 4;
        return (y % 2 * 2 + x % 2) * 4 + (y / 2 * 2 + x / 2);
    }

 private:
    /// Word `k` < 4. By selects: a device puts arrays that are indexed by variables into memory.
    MIR_HD static std::uint32_t word(const Bits128& bits, std::uint32_t k) {
        const std::uint32_t low = (k & 1u) != 0 ? bits.word[1] : bits.word[0];
        const std::uint32_t high = (k & 1u) != 0 ? bits.word[3] : bits.word[2];
        return (k & 2u) != 0 ? high : low;
    }
};

}  // namespace mir
