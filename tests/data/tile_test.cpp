// SPDX-License-Identifier: MIT
#include "mir/data/tile.hpp"

#include "support/catch.hpp"

#include <vector>

using mir::Extent;

TEST_CASE("Tiles cover an image once, in row order, and every luxel finds its tile") {
    const Extent image{100, 70};
    const Extent size = GENERATE(Extent{48, 32}, Extent{16, 16}, Extent{100, 70}, Extent{256, 256},
                                 Extent{1, 70}, Extent{99, 69});
    const auto tiles = mir::cut_into_tiles(image, size);
    const std::uint32_t per_row = mir::tiles_per_row(tiles);
    CHECK(per_row == (image.width + size.width - 1) / size.width);
    CHECK(tiles.size() == std::size_t{per_row} * ((image.height + size.height - 1) / size.height));
    std::vector<int> covered(image.area());
    for (mir::TileIndex t = 0; t < tiles.size(); ++t) {
        REQUIRE(tiles[t].width > 0);
        REQUIRE(tiles[t].width <= size.width);
        REQUIRE(tiles[t].height > 0);
        REQUIRE(tiles[t].height <= size.height);
        for (std::uint32_t y = tiles[t].y; y < tiles[t].y + tiles[t].height; ++y)
            for (std::uint32_t x = tiles[t].x; x < tiles[t].x + tiles[t].width; ++x) {
                ++covered.at(y * image.width + x);
                REQUIRE(mir::tile_holding(tiles, per_row, x, y) == t);
            }
    }
    for (int c : covered) REQUIRE(c == 1);
}

TEST_CASE("An image or a tile without luxels is refused with a reason") {
    for (const auto& [image, tile] : std::vector<std::pair<Extent, Extent>>{
             {{0, 10}, {16, 16}}, {{10, 0}, {16, 16}}, {{10, 10}, {0, 16}}, {{10, 10}, {16, 0}}}) {
        try {
            static_cast<void>(mir::cut_into_tiles(image, tile));
            FAIL("an empty extent was taken");
        } catch (const mir::Error& e) {
            CHECK(e.code() == mir::ErrorCode::invalid_argument);
        }
    }
}

TEST_CASE("The area of a large extent does not overflow") {
    CHECK(Extent{0xFFFFFFFFu, 0xFFFFFFFFu}.area() == 0xFFFFFFFE00000001ull);
}
