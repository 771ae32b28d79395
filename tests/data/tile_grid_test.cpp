// SPDX-License-Identifier: MIT
#include "mir/data/tile_grid.hpp"

#include "support/catch.hpp"

namespace {

using mir::BlockedLayout;
using mir::Extent;
using mir::Tile;
using mir::TileGrid;

bool equal(const Tile& a, const Tile& b) {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

}  // namespace

TEST_CASE("A tile grid says in closed form what cutting into tiles does") {
    const Extent image = GENERATE(Extent{100, 70}, Extent{96, 64}, Extent{1, 1}, Extent{257, 16});
    const Extent size = GENERATE(Extent{48, 32}, Extent{16, 16}, Extent{20, 13}, Extent{512, 512},
                                 Extent{1, 1}, Extent{0xFFFFFFF0u, 16});
    const auto tiles = mir::cut_into_tiles(image, size);
    const auto grid = TileGrid::of(image, tiles);
    REQUIRE(grid.columns() * grid.rows() == tiles.size());
    std::uint32_t blocks = 0;
    for (mir::TileIndex t = 0; t < tiles.size(); ++t) {
        REQUIRE(equal(grid[t], tiles[t]));
        REQUIRE(grid.first_block(t) == blocks);
        const std::uint32_t inside = BlockedLayout::of(tiles[t]).blocks();
        for (std::uint32_t b = 0; b < inside; ++b) REQUIRE(grid.tile_of(blocks + b) == t);
        blocks += inside;
    }
    const auto count = static_cast<mir::TileIndex>(tiles.size());
    CHECK(grid.first_block(count) == blocks);
    CHECK(grid.blocks_across() * grid.blocks_down() == blocks);
    CHECK(grid.size() == std::uint64_t{blocks} * BlockedLayout::block_size);
}

TEST_CASE("The place of a luxel is the inverse of its blocked index") {
    const auto layout = BlockedLayout::of(GENERATE(Tile{0, 0, 16, 16}, Tile{0, 0, 52, 37}));
    for (mir::LuxelIndex i = 0; i < layout.size(); ++i) {
        const mir::LuxelPlace at = layout.place(i);
        REQUIRE(layout(at.x, at.y) == i);
        REQUIRE(at.x < layout.blocks_x * 16);
    }
}
