// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/add_shaded.hpp"
#include "mir/blocks/compiled_for.hpp"
#include "mir/blocks/luxel_block.hpp"
#include "mir/core/instruction_set.hpp"

#include <bit>
#include <limits>

namespace mir::blocks {

/// VPLs for which the lit luxels of a block are known. The luxels of a vector register meet all
/// of them before the next ones do, so that what a shading makes of a luxel alone is computed
/// once.
class LitVpls {
 public:
    /// A bit each in a word.
    static constexpr std::uint32_t capacity = std::numeric_limits<std::uint64_t>::digits;

    [[nodiscard]] bool is_full() const { return count_ == capacity; }

    /// There must be room.
    [[gnu::always_inline]] void add(const Vpl& vpl, const BlockMask& lit) {
        const std::uint64_t bit = std::uint64_t{1} << count_;
        vpls_[count_] = vpl;
        lit_[count_] = lit;
        each_group(
            [&](std::uint32_t group) { lighting_[group] |= lit.packet[group] != 0 ? bit : 0; });
        ++count_;
    }

    /// Adds the light of all to luxels and forgets them. `sums` has a place for each group. For all
    /// of this the caller is compiled for `Set`.
    template <InstructionSet Set, Shading F, class Hits>
    [[gnu::always_inline]] void shade(const LuxelBlock<F, Hits>& block, const F& shading,
                                      GroupRadiance* sums) {
        for (std::uint32_t group = 0; group < groups_per_block; ++group) {
            // A copy: the compiler knows that no luxel is read from it.
            GroupRadiance sum = sums[group];
            shade_group<Set>(block, compiled_for<Set>(shading), group,
                             [&](std::uint32_t) -> GroupRadiance& { return sum; });
            sums[group] = sum;
        }
        count_ = 0;
    }

    /// Adds what each does to the luxels of all groups. `sums` has a place for each VPL.
    template <InstructionSet Set, Shading F, class Hits>
    [[gnu::always_inline]] void shade_each(const LuxelBlock<F, Hits>& block, const F& shading,
                                           GroupRadiance* __restrict sums) {
        for (std::uint32_t group = 0; group < groups_per_block; ++group)
            shade_group<Set>(block, compiled_for<Set>(shading), group,
                             [sums](std::uint32_t i) -> GroupRadiance& { return sums[i]; });
        count_ = 0;
    }

 private:
    /// Adds VPL i to `sum_of(i)` if a luxel of the group sees it. Forgets which do.
    template <InstructionSet Set, class Luxels, Shading F, class SumOf>
    [[gnu::always_inline]] void shade_group(const Luxels& block, const F& shading,
                                            std::uint32_t group, const SumOf& sum_of) {
        const std::uint64_t lighting = lighting_[group];
        lighting_[group] = 0;
        if (lighting == 0) return;
        shade_runs<LaneRun<0, lanes_shaded_by(Set)>>(block, shading, group, lighting, sum_of);
    }

    /// The same for a run of the group's lanes and for those after it.
    template <class Run, class Luxels, Shading F, class SumOf>
    [[gnu::always_inline]] void shade_runs(const Luxels& block, const F& shading,
                                           std::uint32_t group, std::uint64_t lighting,
                                           const SumOf& sum_of) {
        shade_run<Run>(block, shading, group, lighting, sum_of);
        if constexpr (!Run::is_last)
            shade_runs<typename Run::Next>(block, shading, group, lighting, sum_of);
    }

    /// The same for one run, VPLs in the order of bits in `left`. It has some. The loop always
    /// shades, so that what does not change in it may move out of it.
    template <class Run, class Luxels, Shading F, class SumOf>
    [[gnu::always_inline]] void shade_run(const Luxels& block, const F& shading,
                                          std::uint32_t group, std::uint64_t left,
                                          const SumOf& sum_of) {
        const auto hits = starting_at(block.hits, group * group_size + Run::first);
        const auto surfaces = starting_at(block.surfaces, group * group_size + Run::first);
        auto i = static_cast<std::uint32_t>(std::countr_zero(left));
        WaysAhead ahead;
        if constexpr (DistanceShading<F>) find_ways<F>(Run{}, hits, vpls_[i], ahead);
        do {
            left &= left - 1;
            // After the last, once more the last.
            const auto next = left == 0 ? i : static_cast<std::uint32_t>(std::countr_zero(left));
            add_shaded(Run{}, hits, surfaces, vpls_[i], vpls_[next], shading, lit_[i].packet[group],
                       ahead, sum_of(i));
            i = next;
        } while (left != 0);
    }

    std::uint32_t count_ = 0;
    Vpl vpls_[capacity];
    BlockMask lit_[capacity];
    std::uint64_t lighting_[groups_per_block] = {};  ///< VPLs that light a group, a bit each
};

}  // namespace mir::blocks
