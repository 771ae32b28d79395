// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/pick_numbers.hpp"

#include <vector>

namespace mir {

/// The PickNumbers of one block, on the host. Keeps those at hand that neighbours share.
class CutPicks {
 public:
    /// `numbers` names the block. The cut may have 2^31 nodes.
    CutPicks(const Random& numbers, std::size_t nodes) : numbers_(numbers) {
        constexpr std::uint32_t shared = PickNumbers::nodes_per_block;
        shifts_.resize((nodes + shared - 1) / shared);
        for (std::uint32_t i = 0; i < shifts_.size(); ++i)
            shifts_[i] = numbers.block(PickNumbers::first_shift + i);
    }

    /// Turns to a group, 0..15.
    void start(std::uint32_t group) {
        group_ = group;
        at_hand_ = none;
    }

    /// The number of node `i` of the cut for the group, a fraction of 2^64. Neighbours are cheapest
    /// one after the other.
    [[nodiscard]] std::uint64_t operator()(std::uint32_t i) {
        const std::uint32_t wanted = PickNumbers::words_of(i, group_);
        if (wanted != at_hand_) words_ = numbers_.block(at_hand_ = wanted);
        return PickNumbers::number(i, group_, words_, shifts_[i / PickNumbers::nodes_per_block]);
    }

 private:
    static constexpr std::uint32_t none = ~0u;

    Random numbers_;
    std::vector<Bits128> shifts_;
    std::uint32_t group_ = 0;
    std::uint32_t at_hand_ = none;
    Bits128 words_{};
};

}  // namespace mir
