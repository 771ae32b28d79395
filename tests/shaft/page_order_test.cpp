// SPDX-License-Identifier: MIT
#include "mir/shaft/device/page_order.hpp"

#include "conformance/worlds.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/shaft/device/page_words.hpp"
#include "shaft/stepped_plane.hpp"
#include "support/catch.hpp"
#include "support/shafts/cluster_order.hpp"

#include <algorithm>
#include <memory>
#include <set>

namespace {

using mir::BlockedLayout;
using mir::Hit;
using mir::LaneGroup;
using mir::LuxelPages;
using mirtest::LuxelPlanes;
using mirtest::size_of_runs;
using mirtest::stepped_plane;

struct Ordered {
    LuxelPlanes luxels;
    std::vector<std::uint32_t> places;
};

/// Number of the slot in the page to which the luxel in slot `k` goes.
std::uint32_t place_of(const Ordered& result, const mir::LuxelPage& page, std::uint32_t k) {
    const std::uint32_t place = result.places[page.slot(k)];
    return place == mir::PageOrder::stays ? k : place;
}

Ordered ordered(const LuxelPlanes& luxels, const BlockedLayout& layout) {
    Ordered result{LuxelPlanes(layout.size()), std::vector<std::uint32_t>(layout.size(), ~0u)};
    const mir::PageOrder order{
        luxels.view(), {layout}, 0.1f, result.luxels.view(), result.places.data()};
    const auto space = std::make_unique<mir::PageOrder::Workspace>();
    for (std::uint32_t i = 0; i < order.pages.count(); ++i) order(LaneGroup{}, i, *space);
    return result;
}

}  // namespace

TEST_CASE("Runs are sorted as a library sorts them") {
    mir::Random random = mirtest::test_random(1);
    for (std::uint32_t count = 64; count <= 1024; count *= 2)
        for (std::uint32_t run = 2; run <= count; run *= 2) {
            std::vector<std::uint64_t> items(count);
            for (std::uint64_t& item : items)
                item = static_cast<std::uint64_t>(1000.0f * random.next());
            std::vector<std::uint64_t> expected = items;
            for (auto at = expected.begin(); at != expected.end(); at += run)
                std::sort(at, at + run);
            mir::sort_runs(LaneGroup{}, items.data(), count, run);
            CHECK(items == expected);
        }
}

TEST_CASE("Pages hold every luxel of a tile once") {
    for (const BlockedLayout layout :
         {BlockedLayout{1, 1}, BlockedLayout{2, 2}, BlockedLayout{5, 4}, BlockedLayout{4, 7}}) {
        std::set<mir::LuxelIndex> seen;
        const LuxelPages pages{layout};
        for (std::uint32_t i = 0; i < pages.count(); ++i)
            for (std::uint32_t k = 0; k < pages[i].luxels(); ++k) seen.insert(pages[i].slot(k));
        CHECK(seen.size() == layout.size());
        CHECK(*seen.rbegin() == layout.size() - 1);
    }
}

TEST_CASE("A page's luxels change places within the page, and clusters become small") {
    const BlockedLayout layout{5, 3};
    const LuxelPlanes luxels = stepped_plane(layout, 21);
    const Ordered result = ordered(luxels, layout);
    const LuxelPages pages{layout};
    for (std::uint32_t i = 0; i < pages.count(); ++i) {
        std::set<std::uint32_t> places;
        bool empty_came = false;
        for (std::uint32_t k = 0; k < pages[i].luxels(); ++k) {
            const mir::LuxelIndex from = pages[i].slot(k);
            const std::uint32_t place = place_of(result, pages[i], k);
            REQUIRE(place < pages[i].luxels());
            places.insert(place);
            const Hit there = result.luxels.view().load(pages[i].slot(place));
            CHECK(there.position == luxels.view().load(from).position);
            CHECK(there.normal == luxels.view().load(from).normal);
            const bool is_empty_now = is_empty(result.luxels.view().load(from));
            if (result.places[from] != mir::PageOrder::stays) CHECK((is_empty_now || !empty_came));
            empty_came = empty_came || is_empty_now;
        }
        CHECK(places.size() == pages[i].luxels());
    }
    mir::InlineExecutor executor;
    LuxelPlanes best(layout.size());
    const auto order = mir::cluster_order(std::as_const(luxels).view(), {}, executor);
    for (std::uint32_t i = 0; i < order.size(); ++i)
        best.view().store(i, luxels.view().load(order[i]));
    const float squares = size_of_runs(luxels.view(), 32);
    const float by_pages = size_of_runs(std::as_const(result.luxels).view(), 32);
    CHECK(by_pages < 0.6f * squares);
    CHECK(by_pages < 1.3f * size_of_runs(std::as_const(best).view(), 32));
}

TEST_CASE("A page on one surface stays as it is") {
    const BlockedLayout layout{5, 3};
    const LuxelPlanes luxels = stepped_plane(layout, 1000);
    const Ordered result = ordered(luxels, layout);
    for (std::uint32_t i = 0; i < layout.size(); ++i) {
        CHECK(result.places[i] == mir::PageOrder::stays);
        CHECK(result.luxels.view().load(i).position == luxels.view().load(i).position);
    }
}

TEST_CASE("Words of ordered luxels come back into the order of the tile") {
    const BlockedLayout layout{3, 5};
    const LuxelPlanes luxels = stepped_plane(layout, 21);
    const Ordered result = ordered(luxels, layout);
    const LuxelPages pages{layout};
    constexpr std::uint32_t vpls = 45;
    mir::Random random = mirtest::test_random(1);
    std::vector<std::uint32_t> truth(layout.size() / 32 * vpls);
    for (std::uint32_t& word : truth)
        word = static_cast<std::uint32_t>(65536.0f * random.next()) * 65537u;
    const mir::VisibilityWords<mir::Space::host> expected{truth.data(), vpls};
    std::vector<std::uint32_t> words(truth.size(), 0u);
    for (std::uint32_t i = 0; i < pages.count(); ++i)
        for (std::uint32_t k = 0; k < pages[i].luxels(); ++k) {
            const mir::LuxelIndex from = pages[i].slot(k);
            const mir::LuxelIndex to = pages[i].slot(place_of(result, pages[i], k));
            for (std::uint32_t j = 0; j < vpls; ++j)
                if (expected.sees(from, j)) words[std::size_t{to / 32} * vpls + j] |= 1u << to % 32;
        }
    const mir::PageWords restore{pages, result.places.data(), vpls, words.data()};
    const auto space = std::make_unique<mir::PageWords::Workspace>();
    for (std::uint32_t i = 0; i < mir::PageWords::groups(pages, vpls); ++i)
        restore(LaneGroup{}, i, *space);
    CHECK(words == truth);
}
