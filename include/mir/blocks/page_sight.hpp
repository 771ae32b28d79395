// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/luxel_block.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/host/page_clusters.hpp"

#include <array>
#include <deque>
#include <optional>
#include <vector>

namespace mir::blocks {

/// One page of a submitted tile. The grain of parallel work where visibility is asked for 256
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

/// Which luxels of a page count, face and see VPLs, by a BlockVisibility. It is asked for 256
/// luxels at a time: blocks of the image, or clusters where packets of the image reach across
/// surfaces and once the page turned out to be worth sorting. The bits are those of the page's
/// blocks, block by block. Nothing is prepared for VPLs that nobody faces.
template <BlockVisibility V>
class PageSight {
 public:
    static constexpr std::uint32_t most_vpls = PageClusters::most_vpls;  ///< at a time
    static_assert(most_vpls <= 32, "a word has a bit for each");

    /// Of a page of a tile. The luxel in a slot of the page counts if it sees something and
    /// `wanted(slot)`. The planes of `tile` and `visibility` must outlive it.
    template <class Wanted>
    PageSight(const SoaView<const Hit>& tile, const LuxelPage& page, const V& visibility,
              InstructionSet set, const Wanted& wanted)
        : visibility_(visibility), set_(set), clusters_(tile, page) {
        meet_luxels(page.blocks(), wanted);
    }
    PageSight(const PageSight&) = delete;
    PageSight& operator=(const PageSight&) = delete;
    ~PageSight() = default;

    /// Asks for VPLs first .. first + count - 1, at most `most_vpls`; those with `matters(vpl)`
    /// count: nobody sees the others. Returns which ones are seen by some luxel: bit k is VPL first
    /// + k.
    template <VplSet P, class Matters>
    [[gnu::always_inline]] std::uint32_t look(const P& vpls, VplIndex first, std::uint32_t count,
                                              const Matters& matters) {
        if (!is_asked_ && !anyone_faces(vpls, first, count, matters)) return 0;
        prepare();
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vpl vpl = vpls[first + k];
            if (!matters(vpl)) continue;
            std::uint32_t c = 0;
            for (Cluster& cluster : known_) {
                const std::uint32_t its = c++;
                if (cluster.luxels.cannot_face(vpl)) continue;
                const BlockMask lit = seen_of(cluster, vpl);
                if (!lit.any()) continue;
                clusters_.set(its, k, lit);
                seen |= 1u << k;
            }
        }
        if (seen != 0) clusters_.restore();
        return seen;
    }

    /// Luxels of block `b` of the page that see the `k`-th VPL asked for last. Only for those that
    /// look() returned a bit of: others may have no value.
    [[nodiscard]] BlockMask seen(std::uint32_t b, std::uint32_t k) const {
        return clusters_.get(b, k);
    }

 private:
    /// How often a VPL has lit a packet in part before the page is sorted. About as much was asked
    /// until then as sorting costs (docs/decisions/002).
    static constexpr std::uint32_t parted_packets_of_sort = 64;

    /// 256 luxels of the page and, once one faces a VPL, the prepared block. The block may refer to
    /// them, so it neither copies nor moves.
    struct Cluster {
        BoundedHitBlock luxels;
        std::optional<typename V::Block> known;

        template <class Wanted>
        Cluster(const PageClusters& page, std::uint32_t c, const Wanted& wanted)
            : luxels(page.hits(c), Block{}, [&](std::uint32_t i) {
                  return wanted(page.slot(c * BlockMask::luxels + i));
              }) {}
    };

    template <class Wanted>
    void meet_luxels(std::uint32_t count, const Wanted& wanted) {
        known_.clear();
        for (std::uint32_t c = 0; c < count; ++c) known_.emplace_back(clusters_, c, wanted);
    }

    template <VplSet P, class Matters>
    [[nodiscard, gnu::always_inline]] bool anyone_faces(const P& vpls, VplIndex first,
                                                        std::uint32_t count,
                                                        const Matters& matters) const {
        for (const Cluster& cluster : known_)
            for (std::uint32_t k = 0; k < count; ++k) {
                const Vpl vpl = vpls[first + k];
                if (!cluster.luxels.cannot_face(vpl) && matters(vpl) &&
                    facing_mask(cluster.luxels, vpl).any())
                    return true;
            }
        return false;
    }

    /// Sorts the page if that is worth its while. Not inlined: as sort().
    [[gnu::noinline]] void prepare() {
        const bool is_first = !is_asked_;
        is_asked_ = true;
        if (is_first ? !clusters_.is_compact() : is_worth_sorting()) sort();
        clusters_.clear();
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
    [[nodiscard, gnu::always_inline]] BlockMask seen_of(Cluster& cluster, const Vpl& vpl) {
        const BlockMask faced = facing_mask(cluster.luxels, vpl);
        if (!faced.any()) return faced;
        if (!cluster.known) know(cluster);
        BlockMask lit = faced;
        visibility_.visible_block(*cluster.known, vpl.position, lit);
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            parted_packets_ += lit.packet[g] != 0 && lit.packet[g] != faced.packet[g] ? 1 : 0;
        return lit;
    }

    // Not inlined: it happens once. A Block need not move, so that it is made in its place, by a
    // conversion whose result is elided (CWG 2327, as compilers have it).
    [[gnu::noinline]] void know(Cluster& cluster) const {
        struct Made {
            const PageSight& sight;
            const Cluster& cluster;
            operator typename V::Block() const {
                return sight.visibility_.block(cluster.luxels.hits, sight.set_);
            }
        };
        cluster.known.emplace(Made{*this, cluster});
    }

    const V& visibility_;
    InstructionSet set_;
    PageClusters clusters_;
    std::deque<Cluster> known_;
    bool is_asked_ = false;             ///< some luxel faced a VPL
    std::uint32_t parted_packets_ = 0;  ///< so far, of a packet and a VPL each
};

}  // namespace mir::blocks
