// SPDX-License-Identifier: MIT
#include "mir/micro/sphere_surfels.hpp"

#include "micro/surfel_worlds.hpp"
#include "mir/micro/surfel_traverse.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::Surfel;
using mir::Vec3;

namespace {

constexpr double pi_ = 3.14159265358979323846;

std::vector<Surfel> cut(float radius, float max_area,
                        mir::DiscExtent extent = mir::DiscExtent::cover) {
    return mir::sphere_surfels({3, -2, 7}, radius, 5, {max_area, extent}, {});
}

/// Share of random points of the sphere whose nearest place on some disc's plane is on the disc.
double covered(const std::vector<Surfel>& surfels, Vec3 centre, float radius) {
    mir::Random random = test_random(990);
    constexpr int points = 2000;
    int inside = 0;
    for (int i = 0; i < points; ++i) {
        const Vec3 p = centre + radius * direction(random);
        inside += std::any_of(surfels.begin(), surfels.end(),
                              [&](const Surfel& s) {
                                  return glm::distance(s.position, p) <= s.radius * (1.0f + 1e-5f);
                              })
                      ? 1
                      : 0;
    }
    return double(inside) / points;
}

}  // namespace

TEST_CASE("Discs of a sphere have its area, touch it and look outwards") {
    const float radius = GENERATE(0.01f, 1.0f, 250.0f);
    const float share = GENERATE(20.0f, 0.3f, 0.01f);
    const float max_area = share * radius * radius;
    const std::vector<Surfel> surfels = cut(radius, max_area);
    double area = 0.0;
    for (const Surfel& s : surfels) {
        area += double(s.area);
        CHECK(s.area <= max_area * (1.0f + 1e-6f));
        CHECK(double(glm::distance(s.position, {3, -2, 7})) == Approx(double(radius)).margin(1e-6));
        CHECK(double(glm::dot(s.normal, glm::normalize(s.position - Vec3(3, -2, 7)))) ==
              Approx(1.0).margin(1e-6 + 1e-7 / double(radius)));
        CHECK((s.material == 5 && s.triangle == Surfel::no_triangle && s.is_whole()));
    }
    // Each area is rounded by itself.
    CHECK(area == Approx(4.0 * pi_ * double(radius) * double(radius)).epsilon(1e-7));
}

TEST_CASE("Patches of a sphere are nearly squares") {
    const std::vector<Surfel> surfels = cut(1.0f, 1e-3f);
    CHECK(double(surfels.size()) < 4.0 * pi_ / 1e-3 * 1.1);
    std::size_t long_ones = 0;
    // The farthest corner of a square of area A is sqrt(A / 2) away.
    for (const Surfel& s : surfels)
        long_ones += double(s.radius) > 1.15 * std::sqrt(0.5 * double(s.area)) ? 1 : 0;
    CHECK(double(long_ones) < 0.02 * double(surfels.size()));  // triangles at the poles
}

TEST_CASE("Covering discs of a sphere leave no gap, those of equal area do") {
    CHECK(covered(cut(2.0f, 0.05f), {3, -2, 7}, 2.0f) == 1.0);
    const double equal = covered(cut(2.0f, 0.05f, mir::DiscExtent::equal_area), {3, -2, 7}, 2.0f);
    CHECK((equal > 0.8 && equal < 0.97));
}

TEST_CASE("Discs of a sphere make a hierarchy that rays meet where the sphere is") {
    mir::InlineExecutor executor;
    const mir::SurfelTree tree(
        cut(1.0f, 1e-3f), [](const mir::Surfel&) { return mir::Rgb{}; }, {}, executor);
    mir::Random random = test_random(991);
    for (int i = 0; i < 200; ++i) {
        const Vec3 out = direction(random);
        const Vec3 origin = Vec3(3, -2, 7) + 5.0f * out;
        const mir::SurfelHit hit = mir::closest_surfel(tree.view(), {origin, -out});
        REQUIRE(hit.node != mir::SurfelHit::none);
        CHECK(double(hit.t) == Approx(4.0).epsilon(1e-3));
        CHECK(hit.front);
    }
}

TEST_CASE("Spheres without surface and with too many discs are refused") {
    CHECK_THROWS_AS(cut(0.0f, 1.0f), mir::Error);
    CHECK_THROWS_AS(cut(std::numeric_limits<float>::infinity(), 1.0f), mir::Error);
    CHECK_THROWS_AS(cut(1.0f, 0.0f), mir::Error);
    CHECK_THROWS_AS(cut(1e15f, 1e-30f), mir::Error);
    mir::Limits few;
    few.surfels = 100;
    CHECK_THROWS_AS(mir::sphere_surfels({0, 0, 0}, 1.0f, 0, {0.01f}, few), mir::Error);
}
