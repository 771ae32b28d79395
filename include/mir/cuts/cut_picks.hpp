// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/cuts/cut_policy.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// The picks of one block: a number for each node and group. The nodes are those of a cut, the
/// groups those of luxels; by the number the node picks a VPL. Numbers of one node are stratified
/// over the groups: neighbouring luxels, and those of a pixel before all, pick from parts of the
/// node that lie far apart, so that their mean is better than that of independent picks. Each
/// number alone is uniform.
class CutPicks {
 public:
    /// `numbers` names the block. The cut may have 2^31 nodes.
    CutPicks(const Random& numbers, std::size_t nodes) : numbers_(numbers) {
        shifts_.resize((nodes + nodes_per_block - 1) / nodes_per_block);
        for (std::uint32_t i = 0; i < shifts_.size(); ++i)
            shifts_[i] = numbers.block(first_shift + i);
    }

    /// Turns to a group, 0..15.
    void start(std::uint32_t group) {
        group_ = group;
        at_hand_ = none;
    }

    /// The number of node `i` of the cut for the group, a fraction of 2^64. Neighbours are cheapest
    /// one after the other.
    [[nodiscard]] std::uint64_t operator()(std::uint32_t i) {
        const std::uint32_t wanted = i / 4 * blocks::groups_per_block + group_;
        if (wanted != at_hand_) words_ = numbers_.block(at_hand_ = wanted);
        const std::uint32_t shift =
            shifts_[i / nodes_per_block].word[i % nodes_per_block / 8] >> i % 8 * 4 & 15u;
        return std::uint64_t{stratum(group_) ^ shift} << 60 | std::uint64_t{words_.word[i % 4]}
                                                                  << 28;
    }

    /// Sixteenth of a node from which a group picks, before the digital shift. Groups are the
    /// places in squares of 4 x 4 luxels: those of each square of 2 x 2 get a quarter each.
    [[nodiscard]] static constexpr std::uint32_t stratum(std::uint32_t group) {
        const std::uint32_t x = group % 4;
        const std::uint32_t y = group / 4;
        return (y % 2 * 2 + x % 2) * 4 + (y / 2 * 2 + x / 2);
    }

 private:
    static constexpr std::uint32_t nodes_per_block = 32;  ///< 4 bits each
    static constexpr std::uint32_t first_shift = 1u << 31;
    static constexpr std::uint32_t none = ~0u;

    Random numbers_;
    std::vector<Bits128> shifts_;
    std::uint32_t group_ = 0;
    std::uint32_t at_hand_ = none;
    Bits128 words_{};
};

}  // namespace mir
