// SPDX-License-Identifier: MIT
#include "mir/micro/make_surfels.hpp"

#include "accel/build_worlds.hpp"
#include "support/catch.hpp"

#include <array>

using namespace mirtest;
using mir::Surfel;
using mir::Vec3;
using Double3 = glm::dvec3;

namespace {

std::vector<Surfel> cut(const World& world, const mir::SurfelOptions& options) {
    mir::InlineExecutor executor;
    return mir::make_surfels(world.geometry, options, {}, executor);
}

/// Twice the area, in extended precision.
long double twice_area(const mir::WorldGeometry& g, std::uint32_t t) {
    std::array<long double, 3> e1{};
    std::array<long double, 3> e2{};
    for (int k = 0; k < 3; ++k) {
        e1[k] = static_cast<long double>(g.corner(t, 1)[k]) - g.corner(t, 0)[k];
        e2[k] = static_cast<long double>(g.corner(t, 2)[k]) - g.corner(t, 0)[k];
    }
    const long double x = e1[1] * e2[2] - e2[1] * e1[2];
    const long double y = e1[2] * e2[0] - e2[2] * e1[0];
    const long double z = e1[0] * e2[1] - e2[0] * e1[1];
    return std::sqrt(x * x + y * y + z * z);
}

/// Centroids of the pieces of a triangle, cut as the description says.
void cut_slowly(Double3 a, Double3 b, Double3 c, std::uint32_t level, std::vector<Double3>& out) {
    if (level == 0) return out.push_back((a + b + c) / 3.0);
    const Double3 ab = 0.5 * (a + b);
    const Double3 bc = 0.5 * (b + c);
    const Double3 ca = 0.5 * (c + a);
    cut_slowly(a, ab, ca, level - 1, out);
    cut_slowly(ab, b, bc, level - 1, out);
    cut_slowly(ca, bc, c, level - 1, out);
    cut_slowly(bc, ca, ab, level - 1, out);
}

/// Share of random points of the triangles that lie in a disc of their triangle.
double covered(const World& world, const std::vector<Surfel>& surfels) {
    mir::Random random = test_random(901);
    std::uint32_t inside = 0;
    constexpr std::uint32_t points = 2000;
    for (std::uint32_t i = 0; i < points; ++i) {
        const mir::SurfacePoint p = random_surface_point(world.geometry, random);
        const bool found = std::any_of(surfels.begin(), surfels.end(), [&](const Surfel& s) {
            return s.triangle == p.triangle &&
                   glm::distance(s.position, p.position) <= s.radius * (1.0f + 1e-5f);
        });
        inside += found ? 1 : 0;
    }
    return double(inside) / points;
}

}  // namespace

TEST_CASE("The pieces of a triangle have its area, rounded once, in exact arithmetic") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    const World soup = triangle_soup(60, 900, scale, scale * Vec3(30, -10, 5));
    const World thin = needles(20, 1e5f, 902);
    for (const World* world : {&soup, &thin})
        for (float area : {1.0f, 0.01f, 1e-4f}) {
            const auto surfels = cut(*world, {.max_area = scale * scale * area});
            // Quarters of single-precision numbers: their sum in double precision is exact.
            std::vector<double> sums(world->geometry.triangles().size());
            for (const Surfel& s : surfels) sums[s.triangle] += double(s.area);
            for (std::uint32_t t = 0; t < sums.size(); ++t) {
                const long double exact = twice_area(world->geometry, t) / 2;
                CHECK(sums[t] == double(float(sums[t])));
                CHECK(std::fabs(double(sums[t] - exact)) <= 0x1.00001p-24 * double(exact));
            }
        }
}

TEST_CASE("No piece is larger than asked for, and none is cut that is not") {
    const World world = triangle_soup(60, 903);
    const float most = 1e-3f;
    for (const Surfel& s : cut(world, {.max_area = most})) {
        const bool whole = double(s.area) == Approx(double(world.geometry.area(s.triangle)));
        CHECK(s.area <= most);
        CHECK((whole || s.area > most / 4));
    }
}

TEST_CASE("Discs lie in the middle of the pieces that cutting in four makes, in that order") {
    const World world = triangle_soup(3, 904, 1.0f, {1, 2, 3});
    const auto surfels = cut(world, {.max_area = 2e-4f});
    std::vector<Double3> centres;
    for (std::uint32_t t = 0; t < 3; ++t) {
        const auto corner = [&](std::uint32_t k) { return Double3(world.geometry.corner(t, k)); };
        const std::uint32_t level = mir::detail::pieces_of(world.geometry, t, {2e-4f}).level;
        REQUIRE(level >= 3);
        cut_slowly(corner(0), corner(1), corner(2), level, centres);
    }
    REQUIRE(centres.size() == surfels.size());
    for (std::size_t i = 0; i < centres.size(); ++i)
        CHECK(glm::distance(centres[i], Double3(surfels[i].position)) < 4.0 * 0x1p-23);
}

TEST_CASE("Covering discs leave no gap, discs of equal area do") {
    const World world = triangle_soup(5, 905);
    const auto cover = cut(world, {1e-2f, mir::DiscExtent::cover});
    CHECK(covered(world, cover) == 1.0);
    const auto equal = cut(world, {1e-2f, mir::DiscExtent::equal_area});
    const double share = covered(world, equal);
    CHECK((share > 0.5 && share < 0.97));
    for (const Surfel& s : equal)
        CHECK(mir::pi * s.radius * s.radius == Approx(s.area).epsilon(1e-6));
}

TEST_CASE("Every point of a triangle lies in one piece of it, and in the disc there") {
    const World soup = triangle_soup(5, 910, 1.0f, {1, 2, 3});
    const World thin = needles(5, 1e3f, 911);
    for (const World* world : {&soup, &thin}) {
        const auto surfels = cut(*world, {.max_area = 2e-3f});
        mir::Random random = test_random(912);
        std::uint32_t in_one = 0;
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const mir::SurfacePoint p = random_surface_point(world->geometry, random);
            std::uint32_t pieces = 0;
            std::uint32_t discs = 0;
            for (const Surfel& s : surfels) {
                const Vec3 off = p.position - s.position;
                if (s.triangle != p.triangle || !s.in_piece(off, 0.0f)) continue;
                ++pieces;
                discs += glm::length(off) <= s.radius * (1.0f + 1e-4f) ? 1 : 0;
            }
            in_one += pieces == 1 && discs == 1 ? 1 : 0;
        }
        // Rounding decides on edges.
        CHECK(in_one >= 1990);
    }
}

TEST_CASE("A disc has the normal and the material of its triangle") {
    mir::Scene scene;
    const std::uint32_t red = scene.add(mir::lambertian("red", {1, 0, 0}));
    const std::uint32_t blue = scene.add(mir::lambertian("blue", {0, 0, 1}));
    scene.place(mir::builtin::quad("floor", blue, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}));
    scene.place(mir::builtin::quad("wall", red, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    const World world(std::move(scene));
    for (const Surfel& s : cut(world, {.max_area = 0.1f})) {
        CHECK(s.material == (s.triangle < 2 ? blue : red));
        CHECK(glm::distance(s.normal, world.geometry.front_normal(s.triangle)) < 1e-6f);
    }
}

TEST_CASE("Discs are the same for any number of threads") {
    const World world = triangle_soup(400, 906);
    const auto one = cut(world, {.max_area = 2e-4f});
    REQUIRE(one.size() > 3 * 4096);
    for (std::size_t threads : {2u, 3u}) {
        BackwardsExecutor executor{threads};
        const auto other = mir::make_surfels(world.geometry, {.max_area = 2e-4f}, {}, executor);
        CHECK(equal_bytes<Surfel>(one, other));
    }
}

TEST_CASE("The surface of a scene is the sum of its discs") {
    const World world = triangle_soup(50, 907);
    double sum = 0.0;
    for (const Surfel& s : cut(world, {.max_area = 1e-3f})) sum += double(s.area);
    CHECK(mir::surface_area(world.geometry) == Approx(sum).epsilon(1e-13));
    const World empty{mir::Scene{}};
    CHECK(mir::surface_area(empty.geometry) == 0.0);
    CHECK(cut(empty, {}).empty());
}

TEST_CASE("More discs than the limits allow are refused before memory is taken") {
    const World world = triangle_soup(10, 908);
    mir::InlineExecutor executor;
    for (float area : {1e-8f, 1e-20f, 1e-38f}) try {
            (void)mir::make_surfels(world.geometry, {.max_area = area}, {}, executor);
            FAIL("all discs were made");
        } catch (const mir::Error& e) {
            CHECK(e.code() == mir::ErrorCode::limit_exceeded);
            CHECK(std::string(e.what()).find("Limits::surfels") != std::string::npos);
        }
    mir::Limits limits;
    limits.surfels = cut(world, {.max_area = 1e-2f}).size();
    CHECK_NOTHROW(mir::make_surfels(world.geometry, {.max_area = 1e-2f}, limits, executor));
    --limits.surfels;
    CHECK_THROWS_AS(mir::make_surfels(world.geometry, {.max_area = 1e-2f}, limits, executor),
                    mir::Error);
}

TEST_CASE("Areas that end no cutting are refused, and triangles beyond single precision") {
    const World world = triangle_soup(2, 909);
    const float area = GENERATE(0.0f, -1.0f, std::numeric_limits<float>::infinity(),
                                std::numeric_limits<float>::quiet_NaN());
    CHECK_THROWS_AS(cut(world, {.max_area = area}), mir::Error);
    mir::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {3e19f, 0, 0}, {0, 3e19f, 0}};
    mesh.triangles = {{0, 1, 2}};
    const World huge = world_of(std::move(mesh));
    REQUIRE(huge.geometry.triangles().size() == 1);
    try {
        (void)cut(huge, {});
        FAIL("discs of infinite area were made");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::invalid_input);
    }
}
