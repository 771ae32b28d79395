// SPDX-License-Identifier: MIT
#include "mir/shading/mean_reflectance.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

using mir::CookTorrance;
using mir::Rgb;
using mir::Vec3;
using mirtest::Approx;

namespace {

CookTorrance::Params surface(float roughness, Rgb f0, float f90, Rgb diffuse) {
    CookTorrance::Params p;
    p.alpha = std::max(roughness * roughness, mir::min_ggx_alpha);
    p.f0 = f0;
    p.f90 = f90;
    p.diffuse = diffuse;
    return p;
}

/// Share of light that goes on, of 100 000 directions of the viewer spread by the cosine.
std::array<mirtest::Moments, 3> sampled(const CookTorrance::Params& p, std::uint64_t seed) {
    std::array<mirtest::Moments, 3> share;
    mir::Random random(seed, mir::Stream::test, 0);
    const Vec3 n(0, 0, 1);
    for (int i = 0; i < 100'000; ++i) {
        const Vec3 wo = mir::square_to_cosine_hemisphere(random.next_2d());
        const mir::Vec2 u = random.next_2d();
        const float lobe = random.next();
        const Rgb w = wo.z > 0.0f ? CookTorrance::sample(p, n, wo, u, lobe).weight : Rgb{};
        share[0].add(w.r);
        share[1].add(w.g);
        share[2].add(w.b);
    }
    return share;
}

}  // namespace

// Within 0.003 and 4 standard errors of the mean over random directions, seeds 1301 on.
TEST_CASE("the mean reflectance is the share of light from everywhere that goes on",
          "[statistical]") {
    std::uint64_t seed = 1301;
    for (const float roughness : {0.02f, 0.1f, 0.33f, 0.5f, 0.72f, 0.9f, 1.0f})
        for (const CookTorrance::Params& p :
             {surface(roughness, {1, 1, 1}, 1, {}), surface(roughness, {0.9f, 0.6f, 0.2f}, 1, {}),
              surface(roughness, {0.04f, 0.04f, 0.04f}, 1, {0.8f, 0.5f, 0.1f}),
              surface(roughness, {0.04f, 0.3f, 0}, 0.5f, {0.2f, 0.5f, 0.9f})}) {
            const Rgb told = mean_reflectance(p);
            const auto drawn = sampled(p, seed++);
            CAPTURE(roughness, told.r, told.g, told.b);
            const std::array channels{told.r, told.g, told.b};
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(std::fabs(double(channels[c]) - drawn[c].mean()) <
                      0.003 + 4.0 * drawn[c].standard_error());
        }
}

TEST_CASE("the mean reflectance of surfaces without an interface is their colour") {
    CHECK(mean_reflectance(mir::Lambert::Params{{0.1f, 0.5f, 0.9f}}) == Rgb{0.1f, 0.5f, 0.9f});
    CHECK(mean_reflectance(surface(0.5f, {}, 0, {0.1f, 0.5f, 0.9f})) == Rgb{0.1f, 0.5f, 0.9f});
}

TEST_CASE("rough metal loses the light that its facets would reflect twice") {
    const Rgb smooth = mean_reflectance(surface(0, {1, 1, 1}, 1, {}));
    const Rgb rough = mean_reflectance(surface(1, {1, 1, 1}, 1, {}));
    CHECK(double(smooth.g) == Approx(1.0).margin(1e-3));
    CHECK(double(rough.g) == Approx(0.409).margin(3e-3));
}
