// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/device/page_order.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

namespace mir {

/// Puts words of a PageOrder's slots back into blocked order, in place. Kernel for groups, a page
/// and 32 VPLs each.
struct PageWords {
    /// Words of a whole page and a VPL.
    static constexpr std::uint32_t most_words = LuxelPage::most_luxels / cluster_luxels;

    /// What a group works in.
    struct Workspace {
        std::uint32_t words[most_words][LaneGroup::width];  ///< of the page's slots, a VPL per lane
        std::uint16_t places[LuxelPage::most_luxels];       ///< by slot in blocked order
    };

    LuxelPages pages;                       ///< of the tile
    const std::uint32_t* places = nullptr;  ///< PageOrder::places
    std::uint32_t vpls = 0;                 ///< those of the words
    std::uint32_t* words = nullptr;         ///< as VisibilityWords

    /// Groups that cover all words.
    [[nodiscard]] static std::uint32_t groups(const LuxelPages& pages, std::uint32_t vpls) {
        return pages.count() * ((vpls + LaneGroup::width - 1) / LaneGroup::width);
    }

    /// Page i % count and the 32 VPLs from 32 (i / count) on.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const LuxelPage page = pages[i % pages.count()];
        if (places[page.slot(0)] == PageOrder::stays) return;
        const std::uint32_t first = i / pages.count() * LaneGroup::width;
        read(group, page, first, space);
        for (std::uint32_t c = 0; c < page.luxels() / cluster_luxels; ++c)
            group.each([&](std::uint32_t lane) {
                std::uint32_t word = 0;
                for (std::uint32_t k = 0; k < cluster_luxels; ++k) {
                    const std::uint32_t place = space.places[c * cluster_luxels + k];
                    const std::uint32_t from = space.words[place / cluster_luxels][lane];
                    // Bit 0 comes in at the top, and is at bit k in the end.
                    word = word >> 1 | (from >> place % cluster_luxels) << 31;
                }
                if (first + lane < vpls) words[word_of(page, c) + first + lane] = word;
            });
    }

 private:
    MIR_HD void read(const LaneGroup& group, const LuxelPage& page, std::uint32_t first,
                     Workspace& space) const {
        group.each([&](std::uint32_t lane) {
            for (std::uint32_t c = 0; c < page.luxels() / cluster_luxels; ++c)
                space.words[c][lane] =
                    first + lane < vpls ? words[word_of(page, c) + first + lane] : 0u;
            for (std::uint32_t k = lane; k < page.luxels(); k += LaneGroup::width)
                space.places[k] = static_cast<std::uint16_t>(places[page.slot(k)]);
        });
    }

    /// Place of the word of cluster `c` of a page and the first VPL.
    [[nodiscard]] MIR_HD std::size_t word_of(const LuxelPage& page, std::uint32_t c) const {
        return std::size_t{page.slot(c * cluster_luxels) / cluster_luxels} * vpls;
    }
};

}  // namespace mir
