// SPDX-License-Identifier: MIT
#include "mir/sampling/vsl_radii.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

using mirtest::Approx;

namespace {

/// VPLs all over a square of this side in the plane z = 0.
std::vector<mir::Vpl> square_of(std::uint32_t count, float side) {
    mir::Random random(17, mir::Stream::test, 0);
    std::vector<mir::Vpl> vpls(count);
    for (mir::Vpl& v : vpls) v.position = {side * random.next(), side * random.next(), 0.0f};
    return vpls;
}

float brute_force(const std::vector<mir::Vpl>& vpls, std::size_t j, std::uint32_t k) {
    std::vector<float> squared;
    for (const mir::Vpl& v : vpls)
        squared.push_back(mir::length_squared(v.position - vpls[j].position));
    std::sort(squared.begin(), squared.end());
    return squared[k];
}

std::vector<float> radii_of(const std::vector<mir::Vpl>& vpls, double area, float scale) {
    mir::InlineExecutor executor;
    return mir::vsl_radii(vpls, area, scale, executor);
}

}  // namespace

TEST_CASE("radii follow the distance to the tenth neighbour") {
    mir::Random random(18, mir::Stream::test, 0);
    auto vpls = square_of(400, 2.0f);
    for (mir::Vpl& v : vpls) v.position.z = random.next() * random.next();
    for (std::size_t i = 0; i < 30; ++i) vpls[i].position.y = 0.5f;  // equal coordinates
    const auto radii = radii_of(vpls, 1e-9, 3.0f);
    for (std::size_t j = 0; j < vpls.size(); ++j)
        REQUIRE(radii[j] == Approx(3.0 * std::sqrt(brute_force(vpls, j, 10) / 10.0)).epsilon(1e-6));
}

TEST_CASE("spheres of VPLs that cover a square evenly are the discs of their share") {
    const auto radii = radii_of(square_of(20000, 2.0f), 4.0, 1.0f);
    double squares = 0.0;
    for (const float r : radii) squares += double(r) * double(r);
    // The squared distance to the k-th of N points has the mean k A / (pi N); edges add a little.
    CHECK(squares / 20000.0 * 3.14159265 * 20000.0 == Approx(4.0).epsilon(0.06));
}

TEST_CASE("few VPLs, and many on one point, get radii by the visible area") {
    for (const float r : radii_of(square_of(10, 1.0f), 2.0, 0.5f))
        CHECK(r == Approx(0.5 * std::sqrt(2.0 / (3.14159265 * 10.0))));
    for (const float r : radii_of(std::vector<mir::Vpl>(50), 2.0, 1.0f))
        CHECK(r == Approx(0.1 * std::sqrt(2.0 / (3.14159265 * 50.0))));
    CHECK(radii_of(std::vector<mir::Vpl>(50), 0.0, 1.0f)[0] == 0.0f);
    CHECK(radii_of({}, 2.0, 1.0f).empty());
}

TEST_CASE("more neighbours than points are refused") {
    const std::vector<mir::Vec3> places(3);
    const mir::PointTree tree(places);
    CHECK(tree.kth_distance_squared({0, 0, 2}, 3) == 4.0f);
    CHECK_THROWS_AS(tree.kth_distance_squared({}, 4), mir::Error);
    CHECK_THROWS_AS(tree.kth_distance_squared({}, 0), mir::Error);
}

TEST_CASE("spheres shrink from pass to pass, ever more slowly") {
    CHECK(mir::vsl_radius_share(0) == 1.0);
    CHECK(mir::vsl_radius_share(1) == Approx(std::sqrt(5.0 / 6.0)));
    CHECK(mir::vsl_radius_share(2) == Approx(std::sqrt(5.0 / 6.0 * 8.0 / 9.0)));
    // r_i^2 falls as i^(-1/3).
    CHECK(mir::vsl_radius_share(8000) / mir::vsl_radius_share(1000) ==
          Approx(std::sqrt(0.5)).epsilon(1e-3));
}
