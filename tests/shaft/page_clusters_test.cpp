// SPDX-License-Identifier: MIT
#include "mir/shaft/host/page_clusters.hpp"

#include "mir/core/random.hpp"
#include "shaft/stepped_plane.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <set>

namespace {

using mir::BlockedLayout;
using mir::BlockMask;
using mir::Hit;
using mir::LuxelPages;
using mir::PageClusters;
using mirtest::LuxelPlanes;
using mirtest::size_of_runs;
using mirtest::stepped_plane;

Hit luxel(const PageClusters& clusters, std::uint32_t i) {
    return clusters.hits(i / BlockMask::luxels).load(i % BlockMask::luxels);
}

/// Checks that each luxel of a sorted page has one place, and that empty ones come last.
void check_places(const LuxelPlanes& luxels, const mir::LuxelPage& page,
                  const PageClusters& clusters) {
    std::set<std::uint32_t> slots;
    bool empty_came = false;
    for (std::uint32_t i = 0; i < page.luxels(); ++i) {
        const std::uint32_t slot = clusters.slot(i);
        slots.insert(slot);
        const Hit hit = luxel(clusters, i);
        CHECK(hit.position == luxels.view().load(page.slot(slot)).position);
        CHECK(hit.normal == luxels.view().load(page.slot(slot)).normal);
        CHECK((is_empty(hit) || !empty_came));
        empty_came = empty_came || is_empty(hit);
    }
    CHECK(slots.size() == page.luxels());
    CHECK(*slots.rbegin() == page.luxels() - 1);
}

/// Packets of all pages, in squares and sorted, as sums of the diagonals of their boxes, metres.
struct PacketSizes {
    float squares = 0.0f;
    float clusters = 0.0f;
    std::uint32_t compact_pages = 0;
};

PacketSizes sizes_of(const LuxelPlanes& luxels, const BlockedLayout& layout) {
    PacketSizes sizes;
    sizes.squares = size_of_runs(luxels.view(), 16);
    const LuxelPages pages{layout};
    for (std::uint32_t i = 0; i < pages.count(); ++i) {
        PageClusters clusters(luxels.view(), pages[i]);
        sizes.compact_pages += clusters.is_compact() ? 1 : 0;
        CHECK_FALSE(clusters.is_ordered());
        for (std::uint32_t slot = 0; slot < pages[i].luxels(); ++slot)
            CHECK(luxel(clusters, slot).position ==
                  luxels.view().load(pages[i].slot(slot)).position);
        clusters.sort();
        CHECK(clusters.is_ordered());
        check_places(luxels, pages[i], clusters);
        for (std::uint32_t c = 0; c < pages[i].blocks(); ++c)
            sizes.clusters += size_of_runs(clusters.hits(c), 16, BlockMask::luxels);
    }
    return sizes;
}

}  // namespace

TEST_CASE("Packets of a page on one surface are compact as they are, but larger than sorted ones") {
    const BlockedLayout layout{5, 3};
    const PacketSizes sizes = sizes_of(stepped_plane(layout, 1000), layout);
    CHECK(sizes.compact_pages == LuxelPages{layout}.count());
    CHECK(sizes.clusters < 0.9f * sizes.squares);
}

TEST_CASE("Packets keep to one of two surfaces, where those of the image reach across") {
    const BlockedLayout layout{5, 3};
    const PacketSizes edges = sizes_of(stepped_plane(layout, 10), layout);
    CHECK(edges.compact_pages == 0);
    CHECK(edges.clusters < 0.4f * edges.squares);
    const PacketSizes stripes = sizes_of(stepped_plane(layout, 2), layout);
    CHECK(stripes.compact_pages == 0);
    CHECK(stripes.clusters < 0.2f * stripes.squares);
}

TEST_CASE("Pages of every shape are sorted, empty ones and such of numbers that are none too") {
    for (const BlockedLayout layout :
         {BlockedLayout{1, 1}, BlockedLayout{1, 2}, BlockedLayout{2, 1}})
        CHECK(sizes_of(stepped_plane(layout, 3), layout).compact_pages == 0);
    const BlockedLayout layout{2, 2};
    const LuxelPlanes nothing(layout.size());
    PageClusters empty(nothing.view(), LuxelPages{layout}[0]);
    CHECK(empty.is_compact());
    empty.sort();
    CHECK_FALSE(empty.is_ordered());
    const float none = std::numeric_limits<float>::quiet_NaN();
    const float far_away = std::numeric_limits<float>::infinity();
    const std::uint32_t place = GENERATE(0u, 17u, 1023u);
    for (const float odd : {none, far_away, -far_away}) {
        LuxelPlanes luxels = stepped_plane(layout, 3);
        luxels.view().store(place, {mir::Vec3(odd), {0, 0, 1}});
        PageClusters clusters(std::as_const(luxels).view(), LuxelPages{layout}[0]);
        clusters.sort();
        std::set<std::uint32_t> slots;
        for (std::uint32_t i = 0; i < layout.size(); ++i) slots.insert(clusters.slot(i));
        CHECK(slots.size() == layout.size());
        CHECK(*slots.rbegin() == layout.size() - 1);
    }
}

TEST_CASE("Luxels at ever larger distances are sorted") {
    const BlockedLayout layout{2, 2};
    LuxelPlanes luxels(layout.size());
    for (std::uint32_t i = 0; i < layout.size(); ++i) {
        const float x = std::ldexp(1.0f, static_cast<int>(i % 200) - 100);
        luxels.view().store(i, {mir::Vec3(x, 0.0f, 0.0f), {0, 0, 1}});
    }
    PageClusters clusters(std::as_const(luxels).view(), LuxelPages{layout}[0]);
    clusters.sort();
    check_places(luxels, LuxelPages{layout}[0], clusters);
}

TEST_CASE("Masks of clusters come back into the order of the page's blocks") {
    const BlockedLayout layout{3, 2};
    const bool is_sorted = GENERATE(false, true);
    const LuxelPlanes luxels = stepped_plane(layout, 3);
    const LuxelPages pages{layout};
    mir::Random random = mirtest::test_random(1);
    for (std::uint32_t i = 0; i < pages.count(); ++i) {
        const mir::LuxelPage page = pages[i];
        PageClusters clusters(luxels.view(), page);
        if (is_sorted) clusters.sort();
        std::vector<std::uint32_t> seen(page.luxels());  // bit k: VPL k, by slot
        for (std::uint32_t& bits : seen)
            bits = static_cast<std::uint32_t>(65536.0f * random.next());
        for (std::uint32_t c = 0; c < page.blocks(); ++c)
            for (std::uint32_t k = 0; k < PageClusters::most_vpls; ++k) {
                BlockMask mask;
                for (std::uint32_t j = 0; j < BlockMask::luxels; ++j)
                    mask.packet[j / 16] |=
                        (seen[clusters.slot(c * BlockMask::luxels + j)] >> k & 1u) << j % 16;
                clusters.set(c, k, mask);
            }
        clusters.restore();
        std::size_t wrong = 0;
        for (std::uint32_t slot = 0; slot < page.luxels(); ++slot)
            for (std::uint32_t k = 0; k < PageClusters::most_vpls; ++k) {
                const BlockMask mask = clusters.get(slot / BlockMask::luxels, k);
                const std::uint32_t bit =
                    mask.packet[slot % BlockMask::luxels / 16] >> slot % 16 & 1u;
                wrong += bit != (seen[slot] >> k & 1u) ? 1 : 0;
            }
        CHECK(wrong == 0);
    }
}
