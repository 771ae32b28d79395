// SPDX-License-Identifier: MIT
#include "mir/film/luxel_grid.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <set>

namespace {

using mir::Extent;
using mir::LuxelGrid;

/// Strata of one pixel's luxels along one axis, `axis` 0 for x.
std::set<int> strata(const LuxelGrid& grid, std::uint32_t px, std::uint32_t py, int axis,
                     std::uint64_t seed) {
    const auto n = static_cast<float>(grid.per_pixel());
    std::set<int> seen;
    for (std::uint32_t cy = 0; cy < grid.per_pixel_y; ++cy)
        for (std::uint32_t cx = 0; cx < grid.per_pixel_x; ++cx) {
            const mir::Vec2 p = grid.pattern(px, py, seed)(cx, cy);
            seen.insert(static_cast<int>(std::floor(p[axis] * n)));
        }
    return seen;
}

}  // namespace

TEST_CASE("a pixel is cut as nearly square as its number of luxels allows") {
    const auto cut = [](std::uint32_t n) {
        const LuxelGrid grid = mir::luxel_grid({10, 20}, n);
        return Extent{grid.per_pixel_x, grid.per_pixel_y};
    };
    CHECK(cut(1) == Extent{1, 1});
    CHECK(cut(2) == Extent{1, 2});
    CHECK(cut(7) == Extent{1, 7});
    CHECK(cut(8) == Extent{2, 4});
    CHECK(cut(12) == Extent{3, 4});
    CHECK(cut(16) == Extent{4, 4});
    CHECK(cut(64) == Extent{8, 8});
    CHECK(mir::luxel_grid({10, 20}, 8).luxels() == Extent{20, 80});
}

TEST_CASE("the only luxel of a pixel lies at its centre") {
    const LuxelGrid grid = mir::luxel_grid({1920, 1200}, 1);
    CHECK(grid.position(0, 0, 1) == mir::Vec2(0.5f, 0.5f));
    CHECK(grid.position(1919, 1199, 99) == mir::Vec2(1919.5f, 1199.5f));
}

TEST_CASE("luxels of a pixel occupy every stratum of both axes once") {
    for (std::uint32_t n = 2; n <= 64; ++n) {
        const LuxelGrid grid = mir::luxel_grid({1000, 1000}, n);
        INFO(n << " luxels");
        for (const std::uint32_t p : {0u, 17u, 999u}) {
            CHECK(strata(grid, p, 999 - p, 0, 5).size() == n);
            CHECK(strata(grid, p, 999 - p, 1, 5).size() == n);
        }
    }
}

TEST_CASE("a luxel stays in its cell, even far from the origin") {
    for (const std::uint32_t n : {2u, 3u, 16u, 64u}) {
        const LuxelGrid grid = mir::luxel_grid({16'000, 16'000}, n);
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const std::uint32_t x = grid.luxels().width - 1 - i;
            const std::uint32_t y = grid.luxels().height - 1 - 2 * i;
            const mir::Vec2 p = grid.position(x, y, 3);
            // A position is rounded down to the spacing of floats at 16 000, 2^-10.
            const float slack = 0x1p-10f * 8.0f;
            CHECK(std::floor(p.x) == static_cast<float>(x / grid.per_pixel_x));
            CHECK(std::floor(p.y) == static_cast<float>(y / grid.per_pixel_y));
            CHECK(std::floor(p.x * static_cast<float>(grid.per_pixel_x) + slack) >=
                  static_cast<float>(x));
            CHECK(std::floor(p.x * static_cast<float>(grid.per_pixel_x)) <= static_cast<float>(x));
        }
    }
}

TEST_CASE("positions depend on the luxel and the seed alone") {
    const LuxelGrid grid = mir::luxel_grid({64, 64}, 9);
    CHECK(grid.position(20, 31, 7) == grid.position(20, 31, 7));
    CHECK(grid.position(20, 31, 7) != grid.position(20, 31, 8));
    const mir::Vec2 here = grid.position(0, 0, 7);
    const mir::Vec2 next = grid.position(3, 0, 7);
    CHECK(here != next - mir::Vec2(1.0f, 0.0f));
}

TEST_CASE("jitter is uniform inside a pixel", "[statistical]") {
    // Null hypothesis: the x of one luxel per pixel, cell (0, 0) of 2 x 2 scaled to [0, 1), falls
    // into 16 equal bins with equal probability. Chi-squared with 15 degrees of freedom, level
    // 0.001 (critical value 37.7), seed 11.
    const LuxelGrid grid = mir::luxel_grid({128, 128}, 4);
    double counts[16] = {};
    for (std::uint32_t py = 0; py < 128; ++py)
        for (std::uint32_t px = 0; px < 128; ++px) {
            const float x = grid.pattern(px, py, 11)(0, 0).x * 2.0f;
            counts[static_cast<int>(x * 16.0f)] += 1.0;
        }
    double chi_squared = 0.0;
    for (const double count : counts) chi_squared += (count - 1024.0) * (count - 1024.0) / 1024.0;
    CHECK(chi_squared < 37.7);
}

TEST_CASE("a grid that cannot be numbered or held is refused") {
    CHECK_THROWS_AS(mir::luxel_grid({0, 5}, 1), mir::Error);
    CHECK_THROWS_AS(mir::luxel_grid({5, 5}, 0), mir::Error);
    CHECK_THROWS_AS(mir::luxel_grid({5, 5}, 65), mir::Error);
    mir::Limits limits;
    limits.pixels = 99;
    CHECK_NOTHROW(mir::luxel_grid({9, 11}, 64, limits));
    CHECK_THROWS_AS(mir::luxel_grid({10, 10}, 1, limits), mir::Error);
    CHECK_THROWS_AS(mir::luxel_grid({1, 1u << 28}, 61), mir::Error);
}
