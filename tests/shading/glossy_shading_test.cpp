// SPDX-License-Identifier: MIT
#include "mir/shading/glossy_shading.hpp"

#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/material_params.hpp"
#include "mir/shading/widened.hpp"
#include "support/catch.hpp"

namespace {

using mir::CookTorrance;
using mir::Hit;
using mir::Lambert;
using mir::Rgb;
using mir::Vec3;
using mir::Vpl;
using mirtest::Approx;

const Vec3 up(0, 0, 1);

CookTorrance::Params metal(float roughness) {
    mir::Material m;
    m.base_color = {0.9f, 0.6f, 0.3f};
    m.metallic = 1.0f;
    m.roughness = roughness;
    return mir::material_params(m, CookTorrance{});
}

Vec3 direction(mir::Random& random, Vec3 n) {
    return mir::Frame::around(n).to_world(mir::square_to_cosine_hemisphere(random.next_2d()));
}

}  // namespace

TEST_CASE("a lobe of a Lambertian surface shines as the VPL itself") {
    const Rgb rho{0.5f, 0.25f, 1.0f};
    const Rgb power{3.0f, 2.0f, 1.0f};
    const mir::Surface<Lambert::Params> surface{up, up, {}, {{0.7f, 0.7f, 0.7f}}};
    const Hit hit{{0, 0, 0}, up};
    mir::Random random(1, mir::Stream::light_path, 0);
    for (int i = 0; i < 100; ++i) {
        const Vec3 n = -direction(random, up);
        const Vpl vpl{2.0f * direction(random, up), n, power * rho * mir::inv_pi};
        const mir::VplLobe<Lambert> lobe{true, n, direction(random, n), power, {rho}};
        for (const float bound : {0.05f, 1e9f}) {
            const mir::GlossyShading<Lambert> shade{bound};
            const Rgb wanted = mir::VplShading<Lambert>{bound}(hit, surface, vpl);
            CHECK(shade(hit, surface, vpl, lobe).r == Approx(wanted.r).epsilon(1e-5));
            CHECK(shade(hit, surface, vpl, lobe).b == Approx(wanted.b).epsilon(1e-5));
            CHECK(shade(hit, surface, vpl, {}).g == Approx(wanted.g).epsilon(1e-5));
            const mir::GlossyShading<Lambert> removed{bound, true};
            const Rgb rest = mir::RemovedByBound<Lambert>{bound}(hit, surface, vpl);
            CHECK(removed(hit, surface, vpl, lobe).r == Approx(rest.r).epsilon(1e-5));
        }
    }
}

// Light from L by way of V and X to the eye E is what the same mirrored pair of surfaces brings
// from E by way of X and V to L.
TEST_CASE("luxel and VPL may change places") {
    mir::Random random(2, mir::Stream::light_path, 0);
    const auto a = metal(0.4f);
    const auto b = metal(0.7f);
    int lit = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 x(0.0f);
        const Vec3 v = 2.0f * direction(random, up);
        const Vec3 n = -direction(random, up);
        const Vec3 to_eye = direction(random, up);
        const Vec3 to_light = direction(random, n);
        const Rgb one{1, 1, 1};
        const mir::GlossyShading<CookTorrance> shade;
        const Rgb there =
            shade({x, up}, {up, to_eye, {}, a}, Vpl{v, n, one}, {true, n, to_light, one, b});
        const Rgb back =
            shade({v, n}, {n, to_light, {}, b}, Vpl{x, up, one}, {true, up, to_eye, one, a});
        CHECK(there.r == Approx(back.r).epsilon(1e-4));
        CHECK(there.b == Approx(back.b).epsilon(1e-4));
        if (there.r > 0.0f) ++lit;
    }
    CHECK(lit > 200);
}

// H0: the mean of I cos over the hemisphere is the power times the albedo that B::sample() weighs.
// Midpoint rule, 512 x 512 directions; 20 000 samples, 4 standard errors.
TEST_CASE("a lobe sends out what its surface reflects") {
    const Vec3 to_light = glm::normalize(Vec3(0.5f, 0.2f, 0.8f));
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        const mir::VplLobe<CookTorrance> lobe{true, up, to_light, {1, 1, 1}, metal(roughness)};
        constexpr int n = 512;
        double sent = 0.0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const mir::Vec2 u((float(i) + 0.5f) / n, (float(j) + 0.5f) / n);
                sent += double(lobe.intensity(mir::square_to_cosine_hemisphere(u)).r) *
                        double(mir::pi) / (n * n);
            }
        mir::Random random(3, mir::Stream::light_path, 0);
        double sum = 0.0;
        double squares = 0.0;
        constexpr int samples = 20000;
        for (int i = 0; i < samples; ++i) {
            const mir::Vec2 u = random.next_2d();
            const double w =
                double(CookTorrance::sample(lobe.bsdf, up, to_light, u, random.next()).weight.r);
            sum += w;
            squares += w * w;
        }
        const double mean = sum / samples;
        const double error = std::sqrt((squares / samples - mean * mean) / samples);
        CAPTURE(roughness, sent, mean, error);
        CHECK(std::abs(sent - mean) < 4 * error + 2e-3);
        CHECK(sent > 0.3);
    }
}

TEST_CASE("a lobe sends nothing below its shading normal's horizon") {
    const Vec3 n = glm::normalize(Vec3(0.6f, 0, 0.8f));
    const mir::VplLobe<CookTorrance> lobe{true, n, up, {1, 1, 1}, metal(0.5f)};
    CHECK(is_black(lobe.intensity(glm::normalize(Vec3(-0.9f, 0, 0.1f)))));
    CHECK(!is_black(lobe.intensity(glm::normalize(Vec3(0.9f, 0, 0.1f)))));
}

TEST_CASE("lobes are widened up to a width and no further") {
    const auto smooth = metal(0.2f);
    CHECK(mir::is_widened(smooth, 0.25f));
    CHECK(mir::widened(smooth, 0.25f).alpha == 0.25f);
    CHECK(mir::widened(smooth, 0.25f).f0.r == smooth.f0.r);
    const auto rough = metal(0.8f);
    CHECK_FALSE(mir::is_widened(rough, 0.25f));
    CHECK(mir::widened(rough, 0.25f).alpha == rough.alpha);
    const Lambert::Params flat{{0.5f, 0.5f, 0.5f}};
    CHECK_FALSE(mir::is_widened(flat, 1.0f));
    CHECK(mir::widened(flat, 1.0f).reflectance.r == 0.5f);
}
