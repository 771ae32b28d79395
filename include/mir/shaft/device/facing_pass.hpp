// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/shaft/device/faced_blocks.hpp"
#include "mir/shaft/device/facing_records.hpp"
#include "mir/shaft/device/vpl_batch.hpp"

namespace mir {

/// Which luxels face which VPLs, seen or not: what shafts start from. Kernel for groups, a block of
/// 256 luxels and 32 VPLs each. First a VPL per lane against all of the block; then, for VPLs that
/// some luxels may face and others not, 32 luxels at a time, a luxel per lane.
template <VplSet P>
struct FacingPass {
    /// Groups need no memory.
    struct Workspace {};

    SoaView<const Hit> hits;                ///< whole blocks
    const FacingRecord* records = nullptr;  ///< of the blocks
    P vpls;                                 ///< those of the words
    VplBatch batch;                         ///< whose words are written
    std::uint32_t* words = nullptr;         ///< as VisibilityWords
    FacedBlocks faced;                      ///< of the batch; all are written

    /// Groups that cover all luxels and VPLs of a batch.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t luxels, VplBatch batch) {
        return luxels / block_luxels * runs(batch);
    }

    /// Group `i` < groups(). Block i / r and the VPLs from 32 (i % r) of the batch on; there are r
    /// runs of 32.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        const std::uint32_t block = i / runs(batch);
        const FacingRecord& record = records[block];
        const std::uint32_t first = i % runs(batch) * LaneGroup::width;
        LaneGroup::PerLane<Facing> facing;
        LaneGroup::PerLane<std::uint32_t> any;
        group.each([&](std::uint32_t lane) {
            const std::uint32_t k = first + lane;
            facing[lane] =
                k < batch.count ? facing_of(record.bounds, vpls[batch.first + k]) : Facing::none;
            any[lane] = 0;
        });
        const std::uint32_t open =
            group.ballot([&](std::uint32_t lane) { return facing[lane] == Facing::some; });
        for (std::uint32_t c = 0; c < FacingRecord::words; c += at_once) {
            Words word;
            group.each([&](std::uint32_t lane) {
                for (std::uint32_t q = 0; q < at_once; ++q)
                    word[q][lane] = facing[lane] == Facing::all ? record.luxels[c + q] : 0u;
            });
            const std::uint32_t cluster = block * FacingRecord::words + c;
            if (open != 0) vote(group, cluster, batch.first + first, open, word);
            group.each([&](std::uint32_t lane) {
                const std::uint32_t k = first + lane;
                if (k >= batch.count) return;
                for (std::uint32_t q = 0; q < at_once; ++q) {
                    words[std::size_t{cluster + q} * vpls.size() + batch.first + k] = word[q][lane];
                    any[lane] |= word[q][lane];
                }
            });
        }
        group.each([&](std::uint32_t lane) {
            if (first + lane < batch.count) faced.at(block, first + lane) = any[lane] != 0 ? 1 : 0;
        });
    }

 private:
    [[nodiscard]] MIR_HD static std::uint32_t runs(VplBatch batch) {
        return (batch.count + LaneGroup::width - 1) / LaneGroup::width;
    }

    /// Clusters that vote together, so that none waits for the other's numbers.
    static constexpr std::uint32_t at_once = 4;
    static_assert(FacingRecord::words % at_once == 0);
    using Words = LaneGroup::PerLane<std::uint32_t>[at_once];

    /// Gives the lanes of `open` the words of some clusters and their VPL. That is first +
    /// lane.
    MIR_HD void vote(const LaneGroup& group, std::uint32_t cluster, VplIndex first,
                     std::uint32_t open, Words& word) const {
        LaneGroup::PerLane<Hit> luxels[at_once];
        group.each([&](std::uint32_t lane) {
            for (std::uint32_t q = 0; q < at_once; ++q)
                luxels[q][lane] = hits.load((cluster + q) * cluster_luxels + lane);
        });
        for (; open != 0; open &= open - 1) {
            const std::uint32_t k = LaneGroup::lowest(open);
            const Vpl vpl = vpls[first + k];
            std::uint32_t found[at_once];
            for (std::uint32_t q = 0; q < at_once; ++q)
                found[q] =
                    group.ballot([&](std::uint32_t lane) { return faces(luxels[q][lane], vpl); });
            group.each([&](std::uint32_t lane) {
                for (std::uint32_t q = 0; q < at_once; ++q)
                    word[q][lane] = lane == k ? found[q] : word[q][lane];
            });
        }
    }
};
template <class P>
FacingPass(SoaView<const Hit>, const FacingRecord*, P, VplBatch, std::uint32_t*, FacedBlocks)
    -> FacingPass<P>;

}  // namespace mir
