// SPDX-License-Identifier: MIT
//
// A clear coat: what chains carry of it, and what it leaves of the surface below.
#include "mir/shading/clearcoat.hpp"

#include "mir/core/random.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/material_params.hpp"
#include "mir/shading/specular_step.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::CookTorrance;
using mir::MaterialFactors;
using mir::Rgb;
using mir::SpecularEvent;
using mir::SpecularSurface;
using mir::Transport;
using mir::Vec3;
using mirtest::Approx;

const Vec3 up(0, 0, 1);

/// A white base with or without an interface, below a coat.
MaterialFactors lacquer(float metallic, float roughness, float coat_roughness = 0.0f) {
    MaterialFactors m;
    m.base_color = {1, 1, 1};
    m.metallic = metallic;
    m.roughness = roughness;
    m.specular = metallic > 0.0f ? 1.0f : 0.0f;
    m.clearcoat = 1.0f;
    m.clearcoat_roughness = coat_roughness;
    return m;
}

SpecularSurface surface(const MaterialFactors& m, double cosine) {
    return {m, 1.0f, up, up, mirtest::direction(cosine, 0.0), true, true, up};
}

double albedo(const CookTorrance::Params& p, Vec3 wo) {
    return mirtest::integrate_hemisphere(
        64, [&](Vec3 wi) { return CookTorrance::eval(p, up, wi, wo).g * wi.z; });
}

}  // namespace

TEST_CASE("a white base without interface and its coat reflect exactly all light") {
    const CookTorrance::Params p = mir::material_params(lacquer(0.0f, 1.0f), CookTorrance{});
    for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
        CAPTURE(cosine);
        const Vec3 wo = mirtest::direction(cosine, 0.0);
        const auto coat = double(specular_shares(surface(lacquer(0.0f, 1.0f), cosine)).coated);
        CHECK(coat + albedo(p, wo) == Approx(1.0).epsilon(1e-3));
        CHECK(double(CookTorrance::albedo(p, up, wo).g) == Approx(1.0 - coat).epsilon(1e-5));
        // What a coat that takes nothing from the base would do.
        CHECK(coat + albedo(mir::material_params(
                                MaterialFactors{.base_color = {1, 1, 1}, .specular = 0.0f},
                                CookTorrance{}),
                            wo) >
              1.03);
    }
}

TEST_CASE("no coated surface reflects more than it receives") {
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.3f, 0.6f, 1.0f})
            for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
                CAPTURE(metallic, roughness, cosine);
                MaterialFactors m = lacquer(metallic, roughness);
                m.specular = 1.0f;
                const CookTorrance::Params p = mir::material_params(m, CookTorrance{});
                const auto coat = double(specular_shares(surface(m, cosine)).coated);
                CHECK(coat + albedo(p, mirtest::direction(cosine, 0.0)) <= 1.0025);
            }
}

TEST_CASE("what lies below a coat reflects alike both ways") {
    mir::Random random(931, mir::Stream::test, 0);
    for (int i = 0; i < 2000; ++i) {
        MaterialFactors m = lacquer(random.next(), mir::larger(random.next(), 0.15f));
        m.clearcoat = random.next();
        const CookTorrance::Params p = mir::material_params(m, CookTorrance{});
        const Vec3 wi = mir::square_to_cone(random.next_2d(), 0.0f);
        const Vec3 wo = mir::square_to_cone(random.next_2d(), 0.0f);
        const Rgb there = CookTorrance::eval(p, up, wi, wo);
        const Rgb back = CookTorrance::eval(p, up, wo, wi);
        REQUIRE(there.r == Approx(back.r).epsilon(1e-5));
        // A coat takes light and adds none.
        CookTorrance::Params bare = p;
        bare.clearcoat = 0.0f;
        REQUIRE(there.r <= CookTorrance::eval(bare, up, wi, wo).r);
    }
}

TEST_CASE("glass has no coat, and a model without interfaces neither") {
    MaterialFactors m = lacquer(0.0f, 0.0f);
    m.transmission = 0.5f;
    CHECK(mir::material_params(m, CookTorrance{}).clearcoat == 0.0f);
    CHECK(specular_shares(surface(m, 0.5)).coated == 0.0f);
    SpecularSurface s = surface(lacquer(0.0f, 1.0f), 0.5);
    CHECK(specular_shares(s).coated == Approx(0.04 + 0.96 / 32.0));
    s.has_interface = false;
    CHECK(specular_shares(s).coated == 0.0f);
}

// H0: the mean weight of the event is the coat's share where it mirrors, and one where its lobe is
// the end of the chain. 2^15 steps, seed 932, 4.5 standard errors.
TEST_CASE("the event of a coat has its share as mean weight", "[statistical]") {
    for (const float roughness : {0.0f, 0.4f})
        for (const double cosine : {0.2, 0.9}) {
            CAPTURE(roughness, cosine);
            const SpecularSurface s = surface(lacquer(1.0f, 0.5f, roughness), cosine);
            const bool smooth = roughness == 0.0f;
            mirtest::Moments weights;
            for (int i = 0; i < 1 << 15; ++i) {
                mir::Random numbers(932, mir::Stream::test, std::uint64_t(i));
                const auto step = specular_step(s, 0.8f, {Transport::power}, numbers);
                const bool base = step.event == SpecularEvent::stop;
                // The Bsdf knows of the coat by itself.
                if (base) REQUIRE(step.weight.g == Approx(1.0f / step.probability));
                if (!base)
                    REQUIRE(step.event == (smooth ? SpecularEvent::mirror : SpecularEvent::coat));
                weights.add(base ? 0.0 : double(step.weight.g));
            }
            const double expected = smooth ? double(specular_shares(s).coated) : 1.0;
            CHECK(weights.mean() == Approx(expected).margin(4.5 * weights.standard_error()));
        }
}

TEST_CASE("the lobe of a rough coat reflects what the coat takes") {
    const CookTorrance::Params lobe = CookTorrance::coat(1.0f, 0.2f);
    for (const double cosine : {0.5, 0.9}) {
        const Vec3 wo = mirtest::direction(cosine, 0.0);
        const auto coat = double(specular_shares(surface(lacquer(1.0f, 0.5f), cosine)).coated);
        CHECK(albedo(lobe, wo) == Approx(coat).epsilon(0.05));
    }
    CHECK(is_black(lobe.diffuse));
    CHECK(is_black(CookTorrance::coat(0.0f, 0.2f).f0));
}

TEST_CASE("a coat mirrors by the normal without the texture's relief") {
    SpecularSurface s = surface(lacquer(1.0f, 0.5f), 0.8);
    s.normal = glm::normalize(Vec3(0.3f, 0.1f, 0.9f));
    for (std::uint64_t i = 0; i < 1000; ++i) {
        mir::Random numbers(933, mir::Stream::test, i);
        const auto step = specular_step(s, 0.8f, {Transport::radiance, 0.25f}, numbers);
        if (step.event != SpecularEvent::mirror) continue;
        CHECK(step.direction.x == Approx(-s.wo.x));
        CHECK(step.direction.z == Approx(s.wo.z));
        return;
    }
    FAIL("the coat never mirrored");
}
