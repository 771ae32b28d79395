// SPDX-License-Identifier: MIT
#include "mir/compare/tile_luminances.hpp"

#include "support/catch.hpp"

using mirtest::Approx;

TEST_CASE("tiles cover an image once, each with the mean of its pixels") {
    mir::Image<mir::Rgb> image({37, 20});
    for (std::uint32_t y = 0; y < 20; ++y)
        for (std::uint32_t x = 0; x < 37; ++x)
            image(x, y) = mir::Rgb{1.0f, 1.0f, 1.0f} * static_cast<float>(x / 10 + 10 * (y / 10));
    const mir::TileLuminances t = tile_luminances(image, 4);
    CHECK(t.side == 10);
    REQUIRE(t.tiles == mir::Extent{4, 2});
    for (std::uint32_t i = 0; i < 8; ++i)
        CHECK(t.mean[i] == Approx(i % 4 + 10.0 * (i / 4)).epsilon(1e-6));
}

TEST_CASE("tiles are few in large images and not tiny in small ones") {
    const mir::TileLuminances large = tile_luminances(mir::Image<mir::Rgb>({1000, 17}), 16);
    CHECK(large.side == 63);
    CHECK(large.tiles == mir::Extent{16, 1});
    const mir::TileLuminances small = tile_luminances(mir::Image<mir::Rgb>({9, 3}), 16);
    CHECK(small.side == 8);
    CHECK(small.tiles == mir::Extent{2, 1});
    CHECK(small.mean == std::vector<double>(2));
}
