// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/sched/detail/luxel_block.hpp"
#include "mir/shaft/page_clusters.hpp"

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

/// Which luxels of a page count, face and see VPLs, by a BlockVisibility that is asked for clusters
/// of 256 luxels. The bits are those of the page's blocks, block by block.
template <BlockVisibility V>
class PageSight {
 public:
    static constexpr std::uint32_t most_vpls = PageClusters::most_vpls;  ///< at a time

    /// Of a page of a tile; the luxel in a slot of the page counts if it sees something and
    /// `wanted(slot)`. `visibility` must outlive it.
    template <class Wanted>
    PageSight(const SoaView<const Hit>& tile, const LuxelPage& page, const V& visibility,
              InstructionSet set, const Wanted& wanted)
        : clusters_(tile, page) {
        // Both stay where they are: the sights refer to the blocks.
        blocks_.reserve(page.blocks());
        sights_.reserve(page.blocks());
        for (std::uint32_t c = 0; c < page.blocks(); ++c) {
            const std::uint32_t first = c * BlockMask::luxels;
            blocks_.emplace_back(clusters_.hits(), Block{0, c}, [&](std::uint32_t i) {
                return wanted(clusters_.slot(first + i));
            });
            sights_.emplace_back(blocks_.back(), visibility, set);
        }
    }
    PageSight(const PageSight&) = delete;
    PageSight& operator=(const PageSight&) = delete;
    ~PageSight() = default;

    /// Asks for VPLs first .. first + count - 1, at most `most_vpls`, of which those count that
    /// `matters(vpl)`: nobody sees the others.
    template <VplSet P, class Matters>
    [[gnu::always_inline]] void look(const P& vpls, VplIndex first, std::uint32_t count,
                                     const Matters& matters) {
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vpl vpl = vpls[first + k];
            const bool is_asked = matters(vpl);
            for (std::uint32_t c = 0; c < blocks_.size(); ++c)
                clusters_.set(
                    c, k, is_asked && !blocks_[c].cannot_face(vpl) ? sights_[c](vpl) : BlockMask{});
        }
        clusters_.restore();
    }

    /// Luxels of block `b` of the page that see the `k`-th of the VPLs that were asked for last.
    [[nodiscard]] BlockMask seen(std::uint32_t b, std::uint32_t k) const {
        return clusters_.get(b, k);
    }

 private:
    PageClusters clusters_;
    std::vector<HitBlock> blocks_;
    std::vector<BlockSight<V>> sights_;
};

}  // namespace mir::sched::detail
