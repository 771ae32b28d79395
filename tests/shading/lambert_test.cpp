// SPDX-License-Identifier: MIT
#include "mir/shading/lambert.hpp"

#include "mir/concepts/bsdf.hpp"
#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::Lambert;
using mir::Rgb;
using mir::Vec3;
using mirtest::Approx;

static_assert(mir::Bsdf<Lambert>);

const Lambert::Params grey{{0.25f, 0.5f, 1.0f}};
const Vec3 up(0, 0, 1);

}  // namespace

TEST_CASE("a Lambertian surface reflects the same radiance in all directions") {
    for (double i : {0.01, 0.5, 1.0})
        for (double o : {0.01, 0.7}) {
            const Rgb f =
                Lambert::eval(grey, up, mirtest::direction(i, 0), mirtest::direction(o, 2));
            CHECK(f == grey.reflectance * mir::inv_pi);
        }
}

TEST_CASE("the directional albedo of a Lambertian surface is its reflectance") {
    const Vec3 wo = mirtest::direction(0.4, 1.0);
    const double albedo = mirtest::integrate_hemisphere(
        16, [&](Vec3 wi) { return Lambert::eval(grey, up, wi, wo).g * wi.z; });
    CHECK(albedo == Approx(0.5).epsilon(1e-6));
    CHECK(Lambert::albedo(grey, up, wo) == grey.reflectance);
}

TEST_CASE("a sample's weight is the reflectance and its density that of pdf()") {
    const Vec3 n = glm::normalize(Vec3(1, -2, 0.5f));
    mir::Random random(1, mir::Stream::test, 0);
    for (int i = 0; i < 200; ++i) {
        const auto s = Lambert::sample(grey, n, n, random.next_2d(), random.next());
        CHECK(s.weight == grey.reflectance);
        CHECK(s.pdf == Lambert::pdf(grey, n, s.wi, n));
        CHECK(s.pdf == Approx(glm::dot(n, s.wi) / mir::pi).margin(1e-6));
        CHECK(mir::length_squared(s.wi) == Approx(1.0f).epsilon(1e-5));
    }
    CHECK(Lambert::pdf(grey, up, mirtest::direction(-0.5, 0), up) == 0.0f);
}

// H0: samples follow pdf() around a tilted normal. Chi-square on 16 x 16 cells of (cosine,
// azimuth), level 1 %, seed 41; nothing may fall below the surface. A uniform hemisphere must be
// rejected.
TEST_CASE("Lambertian samples follow their density around any normal", "[statistical]") {
    const Vec3 n = glm::normalize(Vec3(-0.6f, 0.3f, -0.7f));
    const mir::Frame frame = mir::Frame::around(n);
    mirtest::Histogram right(16, 16);
    mirtest::Histogram wrong(16, 16);
    const auto add = [&](mirtest::Histogram& h, Vec3 wi) {
        const Vec3 w = frame.to_local(wi);
        h.add(0.5 + 0.5 * static_cast<double>(w.z),
              mirtest::turn(static_cast<double>(w.x), static_cast<double>(w.y)));
    };
    mir::Random random(41, mir::Stream::test, 0);
    for (int i = 0; i < 60'000; ++i) {
        add(right, Lambert::sample(grey, n, n, random.next_2d(), random.next()).wi);
        add(wrong, frame.to_world(mir::square_to_cone(random.next_2d(), 0.0f)));
    }
    const auto density = [&](double x, double turn) {
        const Vec3 w = frame.to_world(mirtest::direction(2 * x - 1, 2 * mirtest::pi * turn));
        return 4 * mirtest::pi * static_cast<double>(Lambert::pdf(grey, n, w, n));
    };
    CHECK(right.against(density).p_value > 0.01);
    CHECK(wrong.against(density).p_value < 0.01);
}
