// SPDX-License-Identifier: MIT
#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "mir/scene/environment_table.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"
#include "support/test_sky.hpp"

namespace {

using mir::Environment;
using mir::EnvironmentSample;
using mir::EnvironmentTable;
using mir::Rgb;
using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;

/// Each texel's red and green are its column and row.
Environment numbered(std::uint32_t width, std::uint32_t height) {
    Environment e;
    e.radiance = mir::Image<Rgb>({width, height});
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            e.radiance(x, y) = {static_cast<float>(x), static_cast<float>(y), 1};
    return e;
}

/// A unit vector and its place in the unrotated image, both from plain trigonometry.
struct Place {
    Vec3 w;
    double u;
    double v;
};
Place at(double u, double v) {
    const double phi = 2.0 * mirtest::pi * (u - 0.5);
    const double theta = mirtest::pi * v;
    return {
        {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)}, u, v};
}

/// Column and row of the sampled direction in the unit square, v as (1 - cos theta) / 2.
Vec2 on_square(Vec3 w) {
    const double turn = mirtest::turn(static_cast<double>(w.x), static_cast<double>(w.z));
    return {turn < 0.5 ? turn + 0.5 : turn - 0.5, 0.5 * (1.0 - static_cast<double>(w.y))};
}

}  // namespace

TEST_CASE("The image's centre is +x, its top +y, columns to the right of the centre go to +z") {
    const EnvironmentTable table(numbered(8, 4));
    const auto sky = table.view();
    const auto texel = [&](Vec3 w) { return Vec2(sky.radiance(w).r, sky.radiance(w).g); };
    const float e = 0.01f;
    CHECK(texel(glm::normalize(Vec3(1, e, -e))) == Vec2(3, 1));
    CHECK(texel(glm::normalize(Vec3(1, -e, e))) == Vec2(4, 2));
    CHECK(texel(glm::normalize(Vec3(e, e, 1))) == Vec2(5, 1));
    CHECK(texel(glm::normalize(Vec3(-e, e, 1))) == Vec2(6, 1));
    CHECK(texel(glm::normalize(Vec3(-1, e, e))) == Vec2(7, 1));
    CHECK(texel(glm::normalize(Vec3(-1, e, -e))) == Vec2(0, 1));
    CHECK(texel(glm::normalize(Vec3(e, e, -1))) == Vec2(2, 1));
    CHECK(sky.radiance({0, 1, 0}).g == 0.0f);
    CHECK(sky.radiance({0, -1, 0}).g == 3.0f);
}

TEST_CASE("Every texel is found in its directions, and turning moves them counter-clockwise") {
    Environment e = numbered(12, 6);
    for (const float rotation : {0.0f, 90.0f, -30.0f, 725.0f}) {
        e.rotation = rotation;
        const EnvironmentTable table(e);
        const double a = mirtest::pi * static_cast<double>(rotation) / 180.0;
        for (std::uint32_t y = 0; y < 6; ++y)
            for (std::uint32_t x = 0; x < 12; ++x) {
                const Vec3 w = at((x + 0.4) / 12, (y + 0.7) / 6).w;
                // The right-handed rotation about +y.
                const Vec3 turned(std::cos(a) * w.x + std::sin(a) * w.z, w.y,
                                  -std::sin(a) * w.x + std::cos(a) * w.z);
                REQUIRE(table.view().radiance(turned) == e.radiance(x, y));
            }
    }
    e.rotation = 90.0f;
    CHECK(EnvironmentTable(e).view().radiance(glm::normalize(Vec3(0.01f, 0.01f, -1))).r == 6.0f);
}

TEST_CASE("What is sampled is what is seen there, with its density") {
    const EnvironmentTable table(mirtest::test_sky());
    const auto sky = table.view();
    CHECK(sky.light_group == 9);
    int beside = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        mir::Random random(171, mir::Stream::test, i);
        const EnvironmentSample s = sky.sample(random.next_2d());
        REQUIRE(glm::length(s.direction) == Approx(1.0f).epsilon(1e-6));
        REQUIRE(s.pdf == sky.density(s.radiance));
        REQUIRE(s.pdf > 0.0f);
        // Rounding moves directions over a border now and then.
        if (sky.radiance(s.direction) != s.radiance) ++beside;
    }
    CHECK(beside < 10);
}

// Midpoint rule on 1200 x 1200 places: texels have borders on its cells.
TEST_CASE("The density integrates to one and the total is that of the luminance") {
    const EnvironmentTable table(mirtest::test_sky());
    constexpr int n = 1200;
    double density = 0.0;
    double light = 0.0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Place p = at((i + 0.5) / n, (j + 0.5) / n);
            const double solid_angle =
                2.0 * mirtest::pi * mirtest::pi / n / n * std::sin(mirtest::pi * p.v);
            const Rgb seen = table.view().radiance(p.w);
            density += solid_angle * static_cast<double>(table.view().density(seen));
            light += solid_angle * static_cast<double>(luminance(seen));
        }
    CHECK(density == Approx(1.0).epsilon(1e-5));
    CHECK(light == Approx(table.view().total()).epsilon(1e-5));
}

// H0: directions have the density. Chi-square on 24 x 24 cells of equal solid angle, level 1 % over
// 2 tests, seeds 172 and 173; uniform directions, and those of a table without solid angles, must
// be rejected.
TEST_CASE("Directions are drawn by their density", "[statistical]") {
    const double level = mirtest::sidak(0.01, 2);
    for (const std::uint64_t seed : {172u, 173u}) {
        const EnvironmentTable table(mirtest::test_sky(seed == 172));
        const auto sky = table.view();
        mirtest::Histogram sampled(24, 24);
        mirtest::Histogram uniform(24, 24);
        for (std::uint64_t i = 0; i < 60'000; ++i) {
            mir::Random random(seed, mir::Stream::test, i);
            const Vec2 p = on_square(sky.sample(random.next_2d()).direction);
            sampled.add(static_cast<double>(p.x), static_cast<double>(p.y));
            const Vec2 q = on_square(mir::square_to_sphere(random.next_2d()));
            uniform.add(static_cast<double>(q.x), static_cast<double>(q.y));
        }
        const auto density = [&](double x, double y) {
            const Vec3 w = at(x, std::acos(1.0 - 2.0 * y) / mirtest::pi).w;
            return 4.0 * mirtest::pi * static_cast<double>(sky.density(sky.radiance(w)));
        };
        const auto flat = [&](double x, double y) {
            return density(x, y) / (0.5 * mirtest::pi * 2.0 * std::sqrt(y * (1.0 - y)));
        };
        CAPTURE(seed);
        CHECK(sampled.against(density, 25).p_value > level);
        CHECK(sampled.against(flat, 25).p_value < level);
        CHECK(uniform.against(density, 25).p_value < level);
    }
}

// Texels next to the pole are smaller than what a cosine next to 1 resolves.
TEST_CASE("Directions of a texel at the pole of a fine image fill it") {
    Environment e;
    e.radiance = mir::Image<Rgb>({4, 8192});
    const bool below = GENERATE(false, true);
    e.radiance(1, below ? 8191 : 0) = {1, 1, 1};
    const EnvironmentTable table(e);
    const double radius = mirtest::pi / 8192;
    double mean = 0.0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / n;
        const Vec3 w = table.view().sample({0.5f, u}).direction;
        const double from_pole = std::hypot(static_cast<double>(w.x), static_cast<double>(w.z));
        REQUIRE((w.y < 0.0f) == below);
        mean += from_pole / radius / n;
    }
    // Of a disc.
    CHECK(mean == Approx(2.0 / 3.0).epsilon(1e-3));
}

TEST_CASE("An environment that shows nothing is empty") {
    CHECK(EnvironmentTable().empty());
    CHECK(EnvironmentTable().view().radiance({0, 1, 0}) == Rgb{});
    CHECK(EnvironmentTable(mirtest::constant_sky({})).empty());
    Environment dark = mirtest::test_sky();
    dark.scale = 0.0f;
    CHECK(EnvironmentTable(dark).empty());
    CHECK(EnvironmentTable(dark).view().radiance({0, 1, 0}) == Rgb{});
}

TEST_CASE("Environments that cannot be are refused by name and place") {
    const auto refused = [](const Environment& e, const std::string& why) {
        try {
            const EnvironmentTable table(e);
        } catch (const mir::Error& error) {
            CAPTURE(error.what());
            CHECK(error.code() == mir::ErrorCode::invalid_input);
            CHECK(std::string(error.what()).find("environment '" + e.name + "'") == 0);
            return std::string(error.what()).find(why) != std::string::npos;
        }
        return false;
    };
    Environment e = mirtest::test_sky();
    e.radiance(3, 2).g = -1.0f;
    CHECK(refused(e, "column 3, row 2"));
    e.radiance(3, 2).g = std::numeric_limits<float>::infinity();
    CHECK(refused(e, "column 3, row 2"));
    e = mirtest::test_sky();
    e.scale = -1.0f;
    CHECK(refused(e, "scale"));
    e.scale = std::numeric_limits<float>::quiet_NaN();
    CHECK(refused(e, "scale"));
    e = mirtest::test_sky();
    e.rotation = std::numeric_limits<float>::infinity();
    CHECK(refused(e, "degrees"));
    e = mirtest::constant_sky({3e38f, 3e38f, 3e38f});
    CHECK(refused(e, "too bright"));
    e.radiance = {};
    CHECK(refused(e, "no texels"));
}
