// SPDX-License-Identifier: MIT
#include "mir/shading/sky_guide.hpp"

#include "mir/scene/environment_table.hpp"
#include "support/catch.hpp"
#include "support/test_sky.hpp"

#include <array>
#include <set>

namespace {

using mir::GuidedNumbers;
using mir::SkyGuide;
using mir::SkyTried;
using mir::Vec2;
using mirtest::Approx;

constexpr std::uint32_t side = SkyTried::side;

/// What tries see that come through in columns 3 to 5 of rows 9 and 10 alone.
SkyTried through_a_window() {
    SkyTried tried;
    for (std::uint32_t k = 0; k < side; ++k)
        for (std::uint32_t c = 3; c < 6; ++c) {
            const std::uint32_t row = SkyTried::row(k, c);
            if (row == 9 || row == 10) tried.seen[k] |= static_cast<std::uint16_t>(1u << c);
        }
    return tried;
}

Vec2 middle(std::uint32_t x, std::uint32_t y) {
    return {(static_cast<float>(x) + 0.5f) / side, (static_cast<float>(y) + 0.5f) / side};
}

}  // namespace

TEST_CASE("sixteen luxels try every cell of the sky once") {
    std::set<std::array<std::uint32_t, 2>> cells;
    for (std::uint32_t k = 0; k < side; ++k)
        for (std::uint32_t c = 0; c < side; ++c) cells.insert({SkyTried::row(k, c), c});
    CHECK(cells.size() == side * side);
}

TEST_CASE("a guide's density is that of its draws and has the integral one") {
    const SkyTried window = through_a_window();
    const SkyGuide guide(&window, 1, 1);
    double integral = 0.0;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x)
            integral += static_cast<double>(guide.density(middle(x, y))) / (side * side);
    CHECK(integral == Approx(1.0).epsilon(1e-6));

    // A fine grid of uniform numbers: each cell gets its share, and every draw its density.
    constexpr std::uint32_t n = 1024;
    std::array<std::array<double, side>, side> share{};
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const GuidedNumbers drawn = guide.draw(
                Vec2((static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n));
            REQUIRE(drawn.numbers.x >= 0.0f);
            REQUIRE(drawn.numbers.x < 1.0f);
            REQUIRE(drawn.numbers.y >= 0.0f);
            REQUIRE(drawn.numbers.y < 1.0f);
            const auto x = static_cast<std::uint32_t>(drawn.numbers.x * side);
            const auto y = static_cast<std::uint32_t>(drawn.numbers.y * side);
            share[y][x] += 1.0 / (double{n} * n);
            if ((i + 31 * j) % 97 == 0)
                REQUIRE(drawn.density == Approx(guide.density(drawn.numbers)));
        }
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x)
            CHECK(share[y][x] ==
                  Approx(static_cast<double>(guide.density(middle(x, y))) / (side * side))
                      .margin(3e-4));
}

TEST_CASE("a guide prefers the window and leaves out nothing") {
    const SkyTried window = through_a_window();
    const SkyGuide guide(&window, 1, 1);
    CHECK(guide.density(middle(4, 9)) > 8.0f);
    CHECK(guide.density(middle(12, 2)) > 0.1f);
    CHECK(guide.density(middle(12, 2)) < 0.5f);
    const SkyTried nothing;
    const SkyGuide blind(&nothing, 1, 1);
    for (const Vec2 u : {Vec2(0.1f, 0.7f), Vec2(0.0f, 0.0f), Vec2(0.99f, 0.5f)}) {
        const GuidedNumbers drawn = blind.draw(u);
        CHECK(drawn.density == 1.0f);
        CHECK(drawn.numbers.x == Approx(u.x).margin(1e-6));
        CHECK(drawn.numbers.y == Approx(u.y).margin(1e-6));
    }
    CHECK_FALSE(window.is_open());
    SkyTried open;
    for (std::uint16_t& bits : open.seen) bits = 0x0F0F;
    CHECK(open.is_open());
}

TEST_CASE("the numbers of a direction are those that it is drawn by") {
    const mir::EnvironmentTable table(mirtest::test_sky());
    const auto sky = table.view();
    for (std::uint64_t i = 0; i < 4000; ++i) {
        mir::Random random(17, mir::Stream::test, i);
        const Vec2 u = random.next_2d();
        const Vec2 back = sky.numbers(sky.sample(u).direction);
        CAPTURE(u.x, u.y, back.x, back.y);
        // Beside the edge of a texel it may be the next one's.
        REQUIRE(back.x == Approx(u.x).margin(2e-4));
        REQUIRE(back.y == Approx(u.y).margin(2e-4));
    }
}
