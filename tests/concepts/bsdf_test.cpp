// SPDX-License-Identifier: MIT
#include "mir/concepts/bsdf.hpp"

#include "conformance/bsdf_suite.hpp"
#include "mir/concepts/archetypes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/material_params.hpp"
#include "support/catch.hpp"

#include <string>

namespace {

namespace archetype = mir::archetype;
using mir::CookTorrance;
using mir::Lambert;

static_assert(mir::Bsdf<archetype::Bsdf>);

struct WithoutEval : archetype::Bsdf {
    static void eval();
};
static_assert(!mir::Bsdf<WithoutEval>);

struct WithoutPdf : archetype::Bsdf {
    static void pdf();
};
static_assert(!mir::Bsdf<WithoutPdf>);

struct WithoutSample : archetype::Bsdf {
    static void sample();
};
static_assert(!mir::Bsdf<WithoutSample>);

struct WithoutAlbedo : archetype::Bsdf {
    static void albedo();
};
static_assert(!mir::Bsdf<WithoutAlbedo>);

struct WithoutIsBlack : archetype::Bsdf {
    static void is_black();
};
static_assert(!mir::Bsdf<WithoutIsBlack>);

struct WithoutParams {
    static mir::Rgb eval(int, mir::Vec3, mir::Vec3, mir::Vec3) { return {}; }
};
static_assert(!mir::Bsdf<WithoutParams>);

struct OwningParams : archetype::Bsdf {
    using Params = std::string;
    static mir::Rgb eval(const Params&, mir::Vec3, mir::Vec3, mir::Vec3) { return {}; }
    static float pdf(const Params&, mir::Vec3, mir::Vec3, mir::Vec3) { return 0.0f; }
    static mir::BsdfSample sample(const Params&, mir::Vec3, mir::Vec3, mir::Vec2, float) {
        return {};
    }
    static mir::Rgb albedo(const Params&, mir::Vec3, mir::Vec3) { return {}; }
    static bool is_black(const Params&) { return true; }
};
static_assert(!mir::Bsdf<OwningParams>);

struct DoublePrecision : archetype::Bsdf {
    static double pdf(const Params&, mir::Vec3, mir::Vec3, mir::Vec3) { return 0.0; }
};
static_assert(!mir::Bsdf<DoublePrecision>);

static_assert(mir::Bsdf<Lambert> && mir::Bsdf<CookTorrance>);

CookTorrance::Params cook_torrance(float roughness, float metallic, float specular,
                                   mir::Rgb color = {1, 1, 1}) {
    mir::Material m;
    m.base_color = color;
    m.roughness = roughness;
    m.metallic = metallic;
    m.specular = specular;
    return material_params(m, CookTorrance{});
}

}  // namespace

TEST_CASE("Lambert keeps the axioms of Bsdf") {
    const std::vector<Lambert::Params> list = {{{1, 1, 1}}, {{0, 0, 0}}, {{0.2f, 0.5f, 1.0f}}};
    mirtest::bsdf_suite<Lambert>(list);
}

TEST_CASE("CookTorrance keeps the axioms of Bsdf for every roughness, metal and interface") {
    const float roughness = GENERATE(0.0f, 0.05f, 0.2f, 0.5f, 0.8f, 1.0f);
    INFO("roughness " << roughness);
    std::vector<CookTorrance::Params> list;
    for (float metallic : {0.0f, 0.3f, 1.0f})
        for (float specular : {0.0f, 0.5f, 1.0f})
            list.push_back(cook_torrance(roughness, metallic, specular));
    list.push_back(cook_torrance(roughness, 1.0f, 1.0f, {0.9f, 0.5f, 0.1f}));
    list.push_back(cook_torrance(roughness, 0.0f, 0.0f, {0.0f, 0.0f, 0.0f}));
    mirtest::bsdf_suite<CookTorrance>(list);
}

TEST_CASE("Samples of the BSDFs follow their densities", "[statistical]") {
    const float cosine = GENERATE(0.95f, 0.5f, 0.15f);
    INFO("cosine " << cosine);
    mirtest::bsdf_samples_follow_pdf<Lambert>({{0.5f, 0.5f, 0.5f}}, cosine);
    const float roughness = GENERATE(0.45f, 0.7f, 1.0f);
    INFO("roughness " << roughness);
    for (float metallic : {0.0f, 1.0f})
        mirtest::bsdf_samples_follow_pdf<CookTorrance>(cook_torrance(roughness, metallic, 1.0f),
                                                       cosine);
}

TEST_CASE("A Lambertian surface reflects its reflectance, which checks the quadrature") {
    for (float cosine : mirtest::usual_cosines) {
        const auto sum =
            mirtest::integrate<Lambert>({{0.25f, 0.5f, 0.75f}}, mirtest::at_angle(cosine, 0.4f));
        CHECK(sum.albedo == mirtest::Approx(0.75).epsilon(2e-3));
        CHECK(sum.pdf == mirtest::Approx(1.0).epsilon(2e-3));
    }
}

TEST_CASE("Without interface CookTorrance is Lambert") {
    const CookTorrance::Params p = cook_torrance(0.3f, 0.0f, 0.0f, {0.2f, 0.4f, 0.6f});
    const mir::Vec3 wi = mirtest::at_angle(0.3f, 1.0f);
    const mir::Vec3 wo = mirtest::at_angle(0.8f, 2.0f);
    const mir::Rgb ours = CookTorrance::eval(p, mirtest::slanted_normal, wi, wo);
    const mir::Rgb theirs = Lambert::eval({{0.2f, 0.4f, 0.6f}}, mirtest::slanted_normal, wi, wo);
    CHECK(ours.r == mirtest::Approx(theirs.r).epsilon(1e-6));
    CHECK(ours.g == mirtest::Approx(theirs.g).epsilon(1e-6));
    CHECK(ours.b == mirtest::Approx(theirs.b).epsilon(1e-6));
}

TEST_CASE("Smooth white surfaces reflect all light, metal and dielectric alike") {
    const float metallic = GENERATE(0.0f, 1.0f);
    for (float cosine : {1.0f, 0.7f, 0.3f}) {
        INFO("metallic " << metallic << ", cosine " << cosine);
        const mir::Vec3 wo = mirtest::at_angle(cosine, 0.4f);
        // alpha = 0.01: masking takes less than a thousandth.
        const auto smooth =
            mirtest::integrate<CookTorrance>(cook_torrance(0.1f, metallic, 1.0f), wo);
        CHECK(smooth.albedo == mirtest::Approx(1.0).margin(5e-3));
        // The narrowest lobe is a few dozen roundings of a direction wide, and loses light to them.
        const auto narrowest =
            mirtest::integrate<CookTorrance>(cook_torrance(0.0f, metallic, 1.0f), wo);
        CHECK(narrowest.albedo == mirtest::Approx(1.0).margin(0.012));
    }
}

TEST_CASE("Fully rough white metal reflects 1 - ln 2 at normal incidence") {
    // alpha = 1: D = 1/pi and V = 1/2 / (1 + cos), so the albedo is int cos / (1 + cos) dcos.
    const auto sum =
        mirtest::integrate<CookTorrance>(cook_torrance(1.0f, 1.0f, 1.0f), mirtest::slanted_normal);
    CHECK(sum.albedo == mirtest::Approx(1.0 - std::log(2.0)).epsilon(2e-3));
}

TEST_CASE("A mirror sends its light along the mirrored direction") {
    const CookTorrance::Params p = cook_torrance(0.0f, 1.0f, 1.0f);
    const mir::Vec3 n = mirtest::slanted_normal;
    const mir::Vec3 wo = mirtest::at_angle(0.6f, 0.4f);
    const mir::Vec3 mirrored = 2.0f * glm::dot(wo, n) * n - wo;
    const float peak = CookTorrance::eval(p, n, mirrored, wo).r;
    const float beside =
        CookTorrance::eval(p, n, glm::normalize(mirrored + 0.05f * mir::Frame::around(n).tangent),
                           wo)
            .r;
    CHECK(peak > 1e4f);
    CHECK(beside < 1e-2f * peak);
}
