// SPDX-License-Identifier: MIT
#include "mir/core/warp.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;
using mirtest::Histogram;
using mirtest::pi;

constexpr int draws = 100'000;
// Every chi-square test of this file belongs to one family of level 1 %.
const double level = mirtest::sidak(0.01, 8);

/// Histogram of `draws` points that `place` makes of points of the unit square.
template <class Place>
Histogram fill(std::uint64_t seed, const Place& place) {
    Histogram h(24, 16);
    mir::Random random(seed, mir::Stream::test, 0);
    for (int i = 0; i < draws; ++i) {
        const auto [x, y] = place(random.next_2d());
        h.add(x, y);
    }
    return h;
}

/// Directions on the unit square: their cosine from [low, 1], and their azimuth. A cell that spans
/// dx dy covers 2 pi (1 - low) dx dy steradians.
std::pair<double, double> on_square(Vec3 w, double low) {
    return {(static_cast<double>(w.z) - low) / (1.0 - low),
            mirtest::turn(static_cast<double>(w.x), static_cast<double>(w.y))};
}
double steradians(double low) { return 2 * pi * (1.0 - low); }

/// Discs on the unit square: area inside their radius, up to 1.5 times that of the disc, and
/// azimuth.
std::pair<double, double> on_square(Vec2 p) {
    const auto x = static_cast<double>(p.x);
    const auto y = static_cast<double>(p.y);
    return {(x * x + y * y) / 1.5, mirtest::turn(x, y)};
}

double disc_density(double x, double /*y*/) { return x < 1.0 / 1.5 ? 1.5 : 0.0; }

double cosine_density(double x, double /*y*/) {
    const double cosine = -1.0 + 2.0 * x;
    return steradians(-1.0) *
           static_cast<double>(mir::cosine_hemisphere_pdf(static_cast<float>(cosine)));
}

double sphere_density(double /*x*/, double /*y*/) {
    return steradians(-1.0) * static_cast<double>(mir::sphere_pdf());
}

/// Cones are looked at in a cone of twice their height.
double low_of(float cos_max) { return 1.0 - 2.0 * (1.0 - static_cast<double>(cos_max)); }
auto cone_density(float cos_max) {
    return [=](double x, double /*y*/) {
        return x > 0.5 ? steradians(low_of(cos_max)) * static_cast<double>(mir::cone_pdf(cos_max))
                       : 0.0;
    };
}

// Uniform on the half of the unit square below its diagonal. The diagonal counts half, because
// quadrature points lie on it.
double triangle_density(double x, double y) {
    const double side = x + y - 1.0;
    if (std::fabs(side) < 1e-9) return 1.0;
    return side < 0.0 ? 2.0 : 0.0;
}
std::pair<double, double> on_square_barycentric(Vec2 p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

}  // namespace

// H0 of the next tests: the samples have the documented density; chi-square on 24 x 16 cells,
// family level 1 %, seeds 11 to 18. Half of the cells or a third lie outside the domain and must be
// empty.
TEST_CASE("points on the disc are uniform", "[statistical]") {
    const Histogram h = fill(11, [](Vec2 u) { return on_square(mir::square_to_disc(u)); });
    CHECK(h.against(disc_density).p_value > level);
}

TEST_CASE("directions of the cosine hemisphere follow their density", "[statistical]") {
    const Histogram h =
        fill(12, [](Vec2 u) { return on_square(mir::square_to_cosine_hemisphere(u), -1.0); });
    CHECK(h.against(cosine_density).p_value > level);
}

TEST_CASE("directions of the sphere are uniform", "[statistical]") {
    const Histogram h = fill(13, [](Vec2 u) { return on_square(mir::square_to_sphere(u), -1.0); });
    CHECK(h.against(sphere_density).p_value > level);
}

TEST_CASE("directions of a cone are uniform inside it", "[statistical]") {
    const float cos_max = GENERATE(0.0f, 0.5f, 0.96875f, 0.9998f);
    const Histogram h = fill(
        14, [=](Vec2 u) { return on_square(mir::square_to_cone(u, cos_max), low_of(cos_max)); });
    CAPTURE(cos_max);
    CHECK(h.against(cone_density(cos_max)).p_value > level);
}

TEST_CASE("barycentric coordinates are uniform over the triangle", "[statistical]") {
    const Histogram h =
        fill(15, [](Vec2 u) { return on_square_barycentric(mir::square_to_triangle(u)); });
    CHECK(h.against(triangle_density, 1).p_value > level);
}

// The tests above must catch bugs: each of these has the classic mistake of its map.
TEST_CASE("chi-square catches wrong maps and wrong densities", "[statistical]") {
    const auto polar_without_root = fill(16, [](Vec2 u) {
        const float phi = 2 * mir::pi * u.y;
        return on_square(u.x * Vec2(std::cos(phi), std::sin(phi)));
    });
    CHECK(polar_without_root.against(disc_density).p_value < level);

    const auto uniform_hemisphere =
        fill(16, [](Vec2 u) { return on_square(mir::square_to_cone(u, 0.0f), -1.0); });
    CHECK(uniform_hemisphere.against(cosine_density).p_value < level);

    const auto uniform_angle = fill(16, [](Vec2 u) {
        return on_square(mirtest::direction(std::cos(pi * static_cast<double>(u.x)),
                                            2 * pi * static_cast<double>(u.y)),
                         -1.0);
    });
    CHECK(uniform_angle.against(sphere_density).p_value < level);

    const auto wider_cone =
        fill(16, [](Vec2 u) { return on_square(mir::square_to_cone(u, 0.49f), low_of(0.5f)); });
    CHECK(wider_cone.against(cone_density(0.5f)).hit_impossible_cell);

    const auto unfolded = fill(16, [](Vec2 u) { return on_square_barycentric({u.x, u.y}); });
    CHECK(unfolded.against(triangle_density, 1).hit_impossible_cell);
    const auto squeezed = fill(16, [](Vec2 u) {
        return on_square_barycentric({u.x, u.y * (1 - u.x)});
    });
    CHECK(squeezed.against(triangle_density, 1).p_value < level);

    const auto half_as_dense = [](double x, double y) { return 0.5 * cosine_density(x, y); };
    const auto cosine =
        fill(16, [](Vec2 u) { return on_square(mir::square_to_cosine_hemisphere(u), -1.0); });
    CHECK(cosine.against(half_as_dense).p_value < level);
}

TEST_CASE("densities of directions integrate to 1") {
    const auto all = [](const auto& pdf) { return mirtest::integrate_directions(-1, 1, 64, pdf); };
    CHECK(all([](Vec3) { return mir::sphere_pdf(); }) == Approx(1.0).epsilon(1e-6));
    CHECK(all([](Vec3 w) { return mir::cosine_hemisphere_pdf(w.z); }) == Approx(1.0).epsilon(1e-5));
    for (float cos_max : {-0.9f, 0.0f, 0.7f, 0.999f})
        CHECK(mirtest::integrate_directions(static_cast<double>(cos_max), 1.0, 4, [=](Vec3) {
                  return mir::cone_pdf(cos_max);
              }) == Approx(1.0).epsilon(1e-5));
}

TEST_CASE("the corners and the centre of the unit square stay inside every domain") {
    for (float x : {0.0f, 0.5f, 0x1.fffffep-1f})
        for (float y : {0.0f, 0.5f, 0x1.fffffep-1f}) {
            const Vec2 u(x, y);
            const Vec2 d = mir::square_to_disc(u);
            CHECK(d.x * d.x + d.y * d.y <= 1.000001f);
            for (Vec3 w : {mir::square_to_cosine_hemisphere(u), mir::square_to_sphere(u),
                           mir::square_to_cone(u, 0.25f)})
                CHECK(mir::length_squared(w) == Approx(1.0f).epsilon(1e-6));
            CHECK(mir::square_to_cosine_hemisphere(u).z >= 0.0f);
            CHECK(mir::square_to_cone(u, 0.25f).z >= 0.25f);
            const Vec2 b = mir::square_to_triangle(u);
            CHECK((b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f));
        }
}

TEST_CASE("the concentric map keeps areas locally") {
    // Area of the image of a small square, by the Jacobian of central differences.
    const float h = 1e-2f;
    for (Vec2 u : {Vec2(0.2f, 0.6f), Vec2(0.9f, 0.5f), Vec2(0.45f, 0.1f), Vec2(0.6f, 0.85f)}) {
        const Vec2 dx = mir::square_to_disc(u + Vec2(h, 0)) - mir::square_to_disc(u - Vec2(h, 0));
        const Vec2 dy = mir::square_to_disc(u + Vec2(0, h)) - mir::square_to_disc(u - Vec2(0, h));
        const float area = (dx.x * dy.y - dx.y * dy.x) / (4 * h * h);
        CHECK(std::fabs(area) == Approx(mir::pi).epsilon(2e-3));
    }
}
