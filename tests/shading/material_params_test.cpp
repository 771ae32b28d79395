// SPDX-License-Identifier: MIT
#include "mir/shading/material_params.hpp"

#include "support/catch.hpp"
#include "support/quadrature.hpp"

namespace {

using mir::CookTorrance;
using mir::Material;
using mir::Rgb;
using mirtest::Approx;

CookTorrance::Params params(const Material& m) { return mir::material_params(m, CookTorrance{}); }

}  // namespace

TEST_CASE("the Lambertian parameters are the base colour") {
    Material m;
    m.base_color = {0.1f, 0.2f, 0.3f};
    CHECK(mir::material_params(m, mir::Lambert{}).reflectance == m.base_color);
}

TEST_CASE("a dielectric reflects ((ior - 1) / (ior + 1))^2 at normal incidence") {
    Material m;
    m.ior = 1.5f;
    CHECK(params(m).f0.r == Approx(0.04f));
    CHECK(params(m).f90 == 1.0f);
    m.ior = 2.0f;
    CHECK(params(m).f0.g == Approx(1.0f / 9));
    m.specular = 0.25f;
    CHECK(params(m).f0.b == Approx(0.25f / 9));
    CHECK(params(m).f90 == 0.25f);
}

TEST_CASE("a metal reflects its colour and has no diffuse base") {
    Material m;
    m.metallic = 1.0f;
    m.specular = 0.0f;
    m.base_color = {1.0f, 0.5f, 0.0f};
    const CookTorrance::Params p = params(m);
    CHECK(p.f0 == m.base_color);
    CHECK(p.f90 == 1.0f);
    CHECK(p.diffuse == Rgb{});
}

TEST_CASE("metallic mixes linearly between dielectric and metal") {
    Material m;
    m.base_color = {0.8f, 0.8f, 0.8f};
    m.metallic = 0.25f;
    CHECK(params(m).f0.r == Approx(0.75f * 0.04f + 0.25f * 0.8f));
}

TEST_CASE("alpha is the square of roughness and never below its smallest value") {
    Material m;
    m.roughness = 0.5f;
    CHECK(params(m).alpha == 0.25f);
    m.roughness = 0.0f;
    CHECK(params(m).alpha == mir::min_ggx_alpha);
    m.roughness = 1.0f;
    CHECK(params(m).alpha == 1.0f);
}

TEST_CASE("without interface the base is left as it is, to the last bit") {
    Material m = mir::lambertian("wall", {0.7f, 0.31f, 0.05f});
    const CookTorrance::Params p = params(m);
    CHECK(p.diffuse == m.base_color);
    CHECK(p.f0 == Rgb{});
    CHECK(p.f90 == 0.0f);
}

TEST_CASE("the base makes up for what the interface reflects on average") {
    // 2 int F(cos) cos dcos is the mean that divides the base.
    Material m;
    m.base_color = {0.6f, 0.6f, 0.6f};
    for (float metallic : {0.0f, 0.3f})
        for (float specular : {0.2f, 1.0f}) {
            m.metallic = metallic;
            m.specular = specular;
            const CookTorrance::Params p = params(m);
            const double mean =
                2 * mirtest::integrate(0.0, 1.0, 8, [&](double c) {
                    return c *
                           static_cast<double>(CookTorrance::schlick(p, static_cast<float>(c)).g);
                });
            CHECK(p.diffuse.g * (1 - mean) == Approx(0.6f * (1 - metallic)).epsilon(1e-5));
        }
}

TEST_CASE("an interface that reflects everything leaves a black base, not an infinite one") {
    Material m;
    m.ior = 1e30f;
    m.base_color = {1, 1, 1};
    const CookTorrance::Params p = params(m);
    CHECK(mir::is_finite(p.diffuse));
    CHECK(mir::is_finite(p.f0));
}
