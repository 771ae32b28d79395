// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sched/detail/luxel_block.hpp"

namespace mir::sched::detail {

/// VPLs of which is known which luxels of a block they light. Sixteen luxels meet all of them
/// before the next sixteen do, so that what a shading makes of a luxel alone is computed once.
class LitVpls {
 public:
    static constexpr std::uint32_t capacity = 64;

    [[nodiscard]] bool is_full() const { return count_ == capacity; }

    /// There must be room.
    void add(const Vpl& vpl, const BlockMask& lit) {
        vpls_[count_] = vpl;
        for (std::uint32_t group = 0; group < groups_per_block; ++group)
            lit_[group][count_] = static_cast<std::uint16_t>(lit.packet[group]);
        ++count_;
    }

    /// Adds the light of all to luxels, `sums` having a place for each group, and forgets them.
    template <Shading F>
    [[gnu::always_inline]] void shade(const LuxelBlock<F>& block, const F& shading,
                                      GroupRadiance* sums) {
        for (std::uint32_t group = 0; group < groups_per_block; ++group) {
            // A copy, of which the compiler knows that no luxel is read from it.
            GroupRadiance sum = sums[group];
            shade_group(block, shading, group,
                        [&](std::uint32_t) -> GroupRadiance& { return sum; });
            sums[group] = sum;
        }
        count_ = 0;
    }

    /// Adds what each does to the luxels of all groups: `sums` has a place for each VPL.
    template <Shading F>
    [[gnu::always_inline]] void shade_each(const LuxelBlock<F>& block, const F& shading,
                                           GroupRadiance* __restrict sums) {
        for (std::uint32_t group = 0; group < groups_per_block; ++group)
            shade_group(block, shading, group,
                        [sums](std::uint32_t i) -> GroupRadiance& { return sums[i]; });
        count_ = 0;
    }

 private:
    /// Adds VPL i to `sum_of(i)`, for each that a luxel of the group sees.
    template <Shading F, class SumOf>
    [[gnu::always_inline]] void shade_group(const LuxelBlock<F>& block, const F& shading,
                                            std::uint32_t group, const SumOf& sum_of) {
        const auto hits = starting_at(block.hits, group * group_size);
        const auto surfaces = starting_at(block.surfaces, group * group_size);
        const std::uint32_t seen = list_seen(lit_[group]);
        for (std::uint32_t s = 0; s < seen; ++s) {
            const std::uint32_t i = seen_[s];
            add_shaded(hits, surfaces, vpls_[i], shading, lit_[group][i], sum_of(i));
        }
    }

    /// Lists those that light a group in seen_ and counts them: a loop over the list alone always
    /// shades, so that what does not change in it may move out of it.
    std::uint32_t list_seen(const std::uint16_t* lit) {
        std::uint32_t seen = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            seen_[seen] = static_cast<std::uint8_t>(i);
            seen += lit[i] != 0 ? 1u : 0u;
        }
        return seen;
    }

    std::uint32_t count_ = 0;
    Vpl vpls_[capacity];
    std::uint16_t lit_[groups_per_block][capacity];
    std::uint8_t seen_[capacity];
};

}  // namespace mir::sched::detail
