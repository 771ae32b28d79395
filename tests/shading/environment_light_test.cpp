// SPDX-License-Identifier: MIT
#include "mir/shading/environment_light.hpp"

#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/statistics.hpp"
#include "support/test_sky.hpp"

namespace {

using mir::Environment;
using mir::Lambert;
using mir::Rgb;
using mir::Scene;
using mir::Vec3;
using mirtest::Approx;
using mirtest::FreeSight;
using mirtest::Moments;

// Every test of a mean in this file belongs to one family of level 1 %.
const double level = mirtest::sidak(0.01, 9);

/// Some surface under a sky. Radiance of a receiver with f = 1 is its irradiance.
struct Under {
    Scene scene;
    mir::WorldGeometry geometry;
    mir::LightTable lights;

    explicit Under(const Environment& sky)
        : scene(below(sky)), geometry(scene), lights(scene, geometry) {}

    static Scene below(const Environment& sky) {
        Scene s;
        s.place(mir::builtin::quad("floor", s.add(mir::lambertian("floor", {1, 1, 1})), {0, 0, 0},
                                   {1, 0, 0}, {0, 0, -1}));
        s.environment = sky;
        return s;
    }
    [[nodiscard]] Rgb irradiance(Vec3 normal, std::uint32_t samples, const mir::Random& random,
                                 mir::SharedSamples shared = {}) const {
        const mir::EnvironmentLight<Lambert, FreeSight> light{lights, {}, samples};
        return light({{}, normal}, {normal, normal, {}, {{mir::pi, mir::pi, mir::pi}}}, shared,
                     random);
    }
};

/// int L_e cos dw over the hemisphere around `normal`, green, by the midpoint rule.
double irradiance_by_quadrature(const Under& under, Vec3 normal) {
    constexpr int n = 720;
    const auto sky = under.lights.environment().view();
    double sum = 0.0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < 2 * n; ++i) {
            const double theta = mirtest::pi * (j + 0.5) / n;
            const double phi = mirtest::pi * (i + 0.5) / n;
            const Vec3 w(std::sin(theta) * std::cos(phi), std::cos(theta),
                         std::sin(theta) * std::sin(phi));
            const double cosine = std::max(static_cast<double>(glm::dot(w, normal)), 0.0);
            sum += static_cast<double>(sky.radiance(w).g) * cosine * std::sin(theta);
        }
    return sum * mirtest::pi * mirtest::pi / n / n;
}

Moments irradiance(const Under& under, Vec3 normal, std::uint64_t seed, std::uint32_t samples,
                   mir::SharedSamples shared = {}) {
    Moments m;
    for (std::uint64_t i = 0; i < 4000; ++i)
        m.add(static_cast<double>(
            under.irradiance(normal, samples, {seed, mir::Stream::test, i}, shared).g));
    return m;
}

}  // namespace

// H0 of these two: Student's t over 4000 estimates, seeds 181 to 187, level 1 % over the file.
TEST_CASE("A constant sky of radiance L gives a free surface the irradiance pi L",
          "[statistical]") {
    const Under under(mirtest::constant_sky({1, 0.5f, 2}));
    const Vec3 slanted = glm::normalize(Vec3(1, 2, -3));
    const Moments m = irradiance(under, slanted, 181, 16);
    CHECK(mirtest::mean_p_value(m, 0.5 * mirtest::pi, 1e-6) > level);
    CHECK(mirtest::mean_p_value(m, 0.51 * mirtest::pi, 1e-6) < level);
}

TEST_CASE("A sky with a sun gives every side of a free surface its irradiance", "[statistical]") {
    const Under under(mirtest::test_sky());
    std::uint64_t seed = 182;
    for (const Vec3 normal :
         {Vec3(0, 1, 0), Vec3(0, -1, 0), glm::normalize(Vec3(-1, 0.2f, 0.5f))}) {
        const double expected = irradiance_by_quadrature(under, normal);
        CAPTURE(normal.x, normal.y, expected);
        for (const mir::SharedSamples shared : {mir::SharedSamples{}, mir::SharedSamples{4, 3}}) {
            const Moments m = irradiance(under, normal, seed++, 17, shared);
            CHECK(mirtest::mean_p_value(m, expected, 1e-5 * expected) > level);
        }
    }
}

TEST_CASE("No sky, a black one and no samples bring nothing") {
    const mir::Random random(1, mir::Stream::test, 0);
    CHECK(is_black(Under(mirtest::constant_sky({})).irradiance({0, 1, 0}, 16, random)));
    CHECK(is_black(Under(mirtest::test_sky()).irradiance({0, 1, 0}, 0, random)));
    Scene none;
    const mir::WorldGeometry geometry(none);
    const mir::LightTable lights(none, geometry);
    CHECK(lights.environment().empty());
    CHECK(lights.empty());
}

TEST_CASE("The power of a sky is what passes the bounding sphere, and it comes last") {
    const Under under(mirtest::constant_sky({1, 1, 1}));
    const double radius = under.lights.sphere().radius;
    CHECK(under.lights.power() ==
          Approx(4 * mirtest::pi * mirtest::pi * radius * radius).epsilon(1e-5));
    const auto has_extent = [](const auto& source) { return source.has_extent; };
    CHECK(under.lights.visit(0, has_extent));
    Scene s = under.scene;
    s.directional_lights.push_back({"sun", {0, -1, 0}, {1, 1, 1}});
    const mir::LightTable both(s, under.geometry);
    CHECK_FALSE(both.visit(0, has_extent));
    CHECK(both.visit(1, has_extent));
}

// H0: what a glossy surface mirrors of a sky with a sun has one mean by directions that its lobe
// chooses too and by luminance alone. Welch's t over 4000 estimates each.
TEST_CASE("directions into a lobe keep the mean of a sky and take its noise", "[statistical]") {
    using mir::CookTorrance;
    const Under under(mirtest::test_sky());
    const mir::EnvironmentLight<CookTorrance, FreeSight> light{under.lights, {}, 8};
    const Vec3 up(0, 1, 0);
    const Vec3 viewer = glm::normalize(Vec3(0.5f, 1, -0.4f));
    std::uint64_t seed = 190;
    for (const float alpha : {0.01f, 0.1f}) {
        const CookTorrance::Params plastic{{0.2f, 0.2f, 0.2f}, {0.04f, 0.04f, 0.04f}, 1, alpha};
        const mir::Surface<CookTorrance::Params> surface{up, viewer, {}, plastic};
        Moments both;
        Moments alone;
        for (std::uint64_t i = 0; i < 4000; ++i) {
            const mir::Random random(seed, mir::Stream::test, i);
            const mir::Random other(seed + 1, mir::Stream::test, i);
            both.add(static_cast<double>(light({{}, up}, surface, {}, random).g));
            alone.add(static_cast<double>(light.from_vpls({{}, up}, surface, other).g));
        }
        seed += 2;
        CAPTURE(alpha, both.mean(), alone.mean(), both.variance(), alone.variance());
        CHECK(mirtest::welch_p_value(both, alone) > level);
        CHECK(both.variance() < (alpha < 0.05f ? 0.4 : 0.95) * alone.variance());
    }
}
