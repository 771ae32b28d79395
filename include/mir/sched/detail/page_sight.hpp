// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/sched/detail/luxel_block.hpp"
#include "mir/shaft/page_clusters.hpp"

#include <array>
#include <deque>
#include <vector>

namespace mir::sched::detail {

/// One page of a submitted tile: the grain of parallel work where visibility is asked for 256
/// luxels at a time.
struct PlacedPage {
    TileIndex tile = 0;  ///< of the image or band
    LuxelPage page;      ///< of that tile
};

/// Appends the pages of a tile.
inline void append_pages(std::vector<PlacedPage>& all, TileIndex index, const Tile& tile) {
    const LuxelPages pages{BlockedLayout::of(tile)};
    for (std::uint32_t i = 0; i < pages.count(); ++i) all.push_back({index, pages[i]});
}

/// Which luxels of a page count, face and see VPLs, by a BlockVisibility that is asked for 256
/// luxels at a time: blocks of the image, or clusters where packets of the image reach across
/// surfaces and once the page turned out to be worth sorting. The bits are those of the page's
/// blocks, block by block.
template <BlockVisibility V>
class PageSight {
 public:
    static constexpr std::uint32_t most_vpls = PageClusters::most_vpls;  ///< at a time

    /// Of a page of a tile; the luxel in a slot of the page counts if it sees something and
    /// `wanted(slot)`. `visibility` must outlive it.
    template <class Wanted>
    PageSight(const SoaView<const Hit>& tile, const LuxelPage& page, const V& visibility,
              InstructionSet set, const Wanted& wanted)
        : visibility_(visibility), set_(set), clusters_(tile, page) {
        if (!clusters_.is_compact()) clusters_.sort();
        meet_luxels(page.blocks(), wanted);
    }
    PageSight(const PageSight&) = delete;
    PageSight& operator=(const PageSight&) = delete;
    ~PageSight() = default;

    /// Asks for VPLs first .. first + count - 1, at most `most_vpls`, of which those count that
    /// `matters(vpl)`: nobody sees the others.
    template <VplSet P, class Matters>
    [[gnu::always_inline]] void look(const P& vpls, VplIndex first, std::uint32_t count,
                                     const Matters& matters) {
        if (is_worth_sorting()) sort();
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vpl vpl = vpls[first + k];
            const bool is_asked = matters(vpl);
            std::uint32_t c = 0;
            for (const Cluster& cluster : known_) {
                const bool can_face = is_asked && !cluster.luxels.cannot_face(vpl);
                clusters_.set(c++, k, can_face ? seen_of(cluster, vpl) : BlockMask{});
            }
        }
        clusters_.restore();
    }

    /// Luxels of block `b` of the page that see the `k`-th of the VPLs that were asked for last.
    [[nodiscard]] BlockMask seen(std::uint32_t b, std::uint32_t k) const {
        return clusters_.get(b, k);
    }

 private:
    /// How often a VPL has lit a packet in part before the page is sorted: about as much was asked
    /// until then as sorting costs (docs/performance.md).
    static constexpr std::uint32_t parted_packets_of_sort = 64;

    /// 256 luxels of the page, and what the visibility knows of them, which may refer to them: so
    /// it neither copies nor moves.
    struct Cluster {
        BoundedHitBlock luxels;
        typename V::Block known;

        template <class Wanted>
        Cluster(const PageClusters& page, std::uint32_t c, const V& visibility, InstructionSet set,
                const Wanted& wanted)
            : luxels(page.hits(), Block{0, c},
                     [&](std::uint32_t i) { return wanted(page.slot(c * BlockMask::luxels + i)); }),
              known(visibility.block(luxels.hits, set)) {}
    };

    template <class Wanted>
    void meet_luxels(std::uint32_t count, const Wanted& wanted) {
        known_.clear();
        for (std::uint32_t c = 0; c < count; ++c)
            known_.emplace_back(clusters_, c, visibility_, set_, wanted);
    }

    [[nodiscard]] bool is_worth_sorting() const {
        return !clusters_.is_ordered() && parted_packets_ >= parted_packets_of_sort;
    }
    // Not inlined: it is not worth a copy for each instruction set.
    [[gnu::noinline]] void sort() {
        std::array<bool, LuxelPage::most_luxels> counts{};
        std::uint32_t slot = 0;
        for (const Cluster& block : known_)
            for (std::uint32_t i = 0; i < BlockMask::luxels; ++i)
                counts[slot++] = block.luxels.counts(i);
        clusters_.sort();
        meet_luxels(static_cast<std::uint32_t>(known_.size()),
                    [&](std::uint32_t its) { return counts[its]; });
    }

    /// Luxels of a cluster that count, face and see a VPL.
    [[nodiscard, gnu::always_inline]] BlockMask seen_of(const Cluster& cluster, const Vpl& vpl) {
        const BlockMask faced = facing_mask(cluster.luxels, vpl);
        BlockMask lit = faced;
        if (faced.any()) visibility_.visible_block(cluster.known, vpl.position, lit);
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            parted_packets_ += lit.packet[g] != 0 && lit.packet[g] != faced.packet[g] ? 1 : 0;
        return lit;
    }

    const V& visibility_;
    InstructionSet set_;
    PageClusters clusters_;
    std::deque<Cluster> known_;
    std::uint32_t parted_packets_ = 0;  ///< so far, of a packet and a VPL each
};

}  // namespace mir::sched::detail
