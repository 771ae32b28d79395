// SPDX-License-Identifier: MIT
#include "mir/data/blocked_layout.hpp"

#include "support/catch.hpp"

#include <set>
#include <utility>
#include <vector>

using mir::BlockedLayout;
using mir::Tile;

TEST_CASE("Every luxel of a tile has a place of its own inside the padded size") {
    const Tile tile = GENERATE(Tile{0, 0, 16, 16}, Tile{32, 16, 48, 32}, Tile{0, 0, 52, 6},
                               Tile{0, 0, 1, 1}, Tile{0, 0, 17, 33});
    const auto layout = BlockedLayout::of(tile);
    CHECK(layout.size() % BlockedLayout::block_size == 0);
    CHECK(layout.blocks() == ((tile.width + 15) / 16) * ((tile.height + 15) / 16));
    std::vector<int> used(layout.size());
    for (std::uint32_t y = 0; y < tile.height; ++y)
        for (std::uint32_t x = 0; x < tile.width; ++x) ++used.at(layout(x, y));
    std::uint64_t once = 0;
    for (int u : used) {
        REQUIRE(u <= 1);
        once += static_cast<std::uint64_t>(u);
    }
    CHECK(once == std::uint64_t{tile.width} * tile.height);
}

TEST_CASE("A block is a bijection of 16 x 16 luxels") {
    std::set<mir::LuxelIndex> seen;
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) seen.insert(BlockedLayout::inside(x, y));
    CHECK(seen.size() == 256);
    CHECK(*seen.rbegin() == 255);
}

namespace {

/// Width and height of the luxels with indices [first, first + count).
std::pair<std::uint32_t, std::uint32_t> box_of(const BlockedLayout& layout, const Tile& tile,
                                               mir::LuxelIndex first, mir::LuxelIndex count) {
    std::set<std::uint32_t> columns;
    std::set<std::uint32_t> rows;
    for (std::uint32_t y = 0; y < tile.height; ++y)
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            const mir::LuxelIndex i = layout(x, y);
            if (i < first || i >= first + count) continue;
            columns.insert(x);
            rows.insert(y);
        }
    return {*columns.rbegin() - *columns.begin() + 1, *rows.rbegin() - *rows.begin() + 1};
}

}  // namespace

TEST_CASE("16, 32 and 256 consecutive luxels are squares of 4 x 4, 8 x 4 and 16 x 16") {
    const Tile tile{0, 0, 48, 32};
    const auto layout = BlockedLayout::of(tile);
    using Box = std::pair<std::uint32_t, std::uint32_t>;
    for (mir::LuxelIndex first = 0; first < layout.size(); first += 16)
        REQUIRE(box_of(layout, tile, first, 16) == Box{4, 4});
    for (mir::LuxelIndex first = 0; first < layout.size(); first += 32)
        REQUIRE(box_of(layout, tile, first, 32) == Box{8, 4});
    for (mir::LuxelIndex first = 0; first < layout.size(); first += 256)
        REQUIRE(box_of(layout, tile, first, 256) == Box{16, 16});
}

TEST_CASE("The areas of blocks cover a ragged tile once and agree with the order of luxels") {
    const Tile tile{100, 200, 52, 38};
    const auto layout = BlockedLayout::of(tile);
    std::uint64_t area = 0;
    for (std::uint32_t b = 0; b < layout.blocks(); ++b) {
        const Tile part = layout.block_area(tile, b);
        REQUIRE(part.width > 0);
        REQUIRE(part.height > 0);
        area += std::uint64_t{part.width} * part.height;
        for (std::uint32_t y = part.y; y < part.y + part.height; ++y)
            for (std::uint32_t x = part.x; x < part.x + part.width; ++x)
                REQUIRE(layout(x, y) / BlockedLayout::block_size == b);
    }
    CHECK(area == 52 * 38);
}
