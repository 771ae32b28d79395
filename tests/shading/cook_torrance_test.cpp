// SPDX-License-Identifier: MIT
#include "mir/shading/cook_torrance.hpp"

#include "mir/concepts/bsdf.hpp"
#include "mir/core/random.hpp"
#include "mir/shading/material_params.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::BsdfSample;
using mir::CookTorrance;
using mir::Material;
using mir::Rgb;
using mir::Vec3;
using mirtest::Approx;
using mirtest::Histogram;

static_assert(mir::Bsdf<CookTorrance>);

const Vec3 up(0, 0, 1);

Material material(float roughness, float metallic) {
    Material m;
    m.base_color = {0.9f, 0.5f, 0.2f};
    m.roughness = roughness;
    m.metallic = metallic;
    return m;
}
CookTorrance::Params params(const Material& m) { return mir::material_params(m, CookTorrance{}); }

struct Setting {
    float roughness;
    float metallic;
    double cosine;  ///< of wo
};

std::vector<Setting> settings() {
    std::vector<Setting> all;
    for (float roughness : {0.3f, 0.6f, 1.0f})
        for (float metallic : {0.0f, 0.5f, 1.0f})
            for (double cosine : {0.95, 0.5, 0.12}) all.push_back({roughness, metallic, cosine});
    return all;
}

/// Narrow lobes near the horizon need finer quadrature.
bool is_thin(Setting at) { return at.cosine < 0.3 && at.roughness < 0.5f; }

/// Samples around a tilted normal on the square of (cosine / 2 + 1 / 2, azimuth); samples to be
/// thrown away lie elsewhere. `pdf(params, n, wi, wo)` is what they are held against.
template <class Pdf>
double sampling_p_value(Setting at, std::uint64_t seed, const Pdf& pdf) {
    const CookTorrance::Params p = params(material(at.roughness, at.metallic));
    const Vec3 n = glm::normalize(Vec3(0.2f, -0.8f, -0.5f));
    const mir::Frame frame = mir::Frame::around(n);
    const Vec3 wo = frame.to_world(mirtest::direction(at.cosine, 1.0));
    Histogram histogram(24, 24);
    mir::Random random(seed, mir::Stream::test, 0);
    for (int i = 0; i < 40'000; ++i) {
        const mir::Vec2 u = random.next_2d();
        const BsdfSample s = CookTorrance::sample(p, n, wo, u, random.next());
        if (s.pdf <= 0.0f) {
            histogram.add_elsewhere();
            continue;
        }
        const Vec3 w = frame.to_local(s.wi);
        histogram.add(0.5 + 0.5 * static_cast<double>(w.z),
                      mirtest::turn(static_cast<double>(w.x), static_cast<double>(w.y)));
    }
    const auto density = [&](double x, double turn) {
        const Vec3 wi = frame.to_world(mirtest::direction(2 * x - 1, 2 * mirtest::pi * turn));
        return 4 * mirtest::pi * static_cast<double>(pdf(p, n, wi, wo));
    };
    return histogram.against(density, is_thin(at) ? 16 : 3).p_value;
}

/// Mean weight of samples, whose expectation is the directional albedo.
mirtest::Moments mean_weight(const CookTorrance::Params& p, Vec3 wo, std::uint64_t seed) {
    mirtest::Moments m;
    mir::Random random(seed, mir::Stream::test, 0);
    for (int i = 0; i < 40'000; ++i) {
        const mir::Vec2 u = random.next_2d();
        m.add(static_cast<double>(CookTorrance::sample(p, up, wo, u, random.next()).weight.g));
    }
    return m;
}

double albedo(const CookTorrance::Params& p, Vec3 wo, int pieces = 48) {
    return mirtest::integrate_hemisphere(
        pieces, [&](Vec3 wi) { return CookTorrance::eval(p, up, wi, wo).g * wi.z; });
}

}  // namespace

// H0: samples follow pdf(), what it lacks to 1 is thrown away. Chi-square on 24 x 24 cells, level
// 1 % over all 27 settings, seeds 51 to 77.
TEST_CASE("Cook-Torrance samples follow their density", "[statistical]") {
    const double level = mirtest::sidak(0.01, settings().size());
    std::uint64_t seed = 51;
    for (Setting at : settings()) {
        CAPTURE(at.roughness, at.metallic, at.cosine);
        CHECK(sampling_p_value(at, seed++, CookTorrance::pdf) > level);
    }
}

TEST_CASE("chi-square catches a density that forgets a lobe or its share", "[statistical]") {
    const double level = mirtest::sidak(0.01, settings().size());
    const Setting at{0.6f, 0.0f, 0.5};
    const auto diffuse_alone = [](const auto&, Vec3 n, Vec3 wi, Vec3) {
        return mir::cosine_hemisphere_pdf(glm::dot(n, wi));
    };
    CHECK(sampling_p_value(at, 78, diffuse_alone) < level);
    const auto without_masking = [](CookTorrance::Params p, Vec3 n, Vec3 wi, Vec3 wo) {
        return CookTorrance::pdf(p, n, wi, wo) / mir::ggx_g1(glm::dot(n, wo), p.alpha);
    };
    CHECK(sampling_p_value({0.6f, 1.0f, 0.5}, 79, without_masking) < level);
    const auto rougher = [](CookTorrance::Params p, Vec3 n, Vec3 wi, Vec3 wo) {
        p.alpha *= 1.1f;
        return CookTorrance::pdf(p, n, wi, wo);
    };
    CHECK(sampling_p_value({0.6f, 1.0f, 0.5}, 80, rougher) < level);
}

// H0: the mean weight is the directional albedo by quadrature. Student's t, level 1 % over all
// settings, seeds 81 to 107. The wrong mean of 1.03 times it must be rejected.
TEST_CASE("sample weights average to the directional albedo", "[statistical]") {
    const double level = mirtest::sidak(0.01, settings().size());
    std::uint64_t seed = 81;
    for (Setting at : settings()) {
        const CookTorrance::Params p = params(material(at.roughness, at.metallic));
        const Vec3 wo = mirtest::direction(at.cosine, 0.5);
        const mirtest::Moments mean = mean_weight(p, wo, seed++);
        CAPTURE(at.roughness, at.metallic, at.cosine);
        const double expected = albedo(p, wo, is_thin(at) ? 160 : 48);
        CHECK(mirtest::mean_p_value(mean, expected, 1e-5) > level);
        CHECK(mirtest::mean_p_value(mean, 1.03 * expected, 1e-5) < level);
    }
}

TEST_CASE("a weight is f cos / pdf of its direction") {
    const CookTorrance::Params p = params(material(0.4f, 0.0f));
    const Vec3 wo = mirtest::direction(0.6, 0.5);
    mir::Random random(4, mir::Stream::test, 0);
    for (int i = 0; i < 200; ++i) {
        const mir::Vec2 u = random.next_2d();
        const BsdfSample s = CookTorrance::sample(p, up, wo, u, random.next());
        if (s.pdf == 0.0f) continue;
        const Rgb f = CookTorrance::eval(p, up, s.wi, wo);
        CHECK(s.pdf == CookTorrance::pdf(p, up, s.wi, wo));
        CHECK(s.weight.r == Approx(f.r * s.wi.z / s.pdf));
        CHECK(s.weight.b == Approx(f.b * s.wi.z / s.pdf));
    }
}

// Under a rough interface Fresnel's term is averaged over the lobe, where its convexity adds up to
// 0.24 % to what the coupling of the base allows for: hence 1.0025 and not 1.
TEST_CASE("no direction reflects more than it receives") {
    Material white = material(0.0f, 0.0f);
    white.base_color = {1, 1, 1};
    for (float roughness : {0.3f, 0.5f, 0.75f, 1.0f})
        for (float metallic : {0.0f, 0.5f, 1.0f})
            for (float ior : {1.0f, 1.5f, 2.4f})
                for (double cosine : {0.05, 0.3, 0.7, 1.0}) {
                    white.roughness = roughness;
                    white.metallic = metallic;
                    white.ior = ior;
                    CAPTURE(roughness, metallic, ior, cosine);
                    const double a = albedo(params(white), mirtest::direction(cosine, 0.0));
                    CHECK(a <= 1.0025);
                }
}

TEST_CASE("the roughest white metal reflects 1 - ln 2 along its normal") {
    // int G2 / (4 pi cos_o) dwi with D = 1/pi and Smith's G2 at alpha 1.
    Material metal = material(1.0f, 1.0f);
    metal.base_color = {1, 1, 1};
    CHECK(albedo(params(metal), up) == Approx(1.0 - std::log(2.0)).epsilon(1e-4));
}

// H0: the mean weight is 1 (within 0.2 % for the lobe's width). Level 1 % over 8, seeds 111 to 118.
TEST_CASE("a white base under a smooth interface reflects all light", "[statistical]") {
    Material white = material(0.1f, 0.0f);
    white.base_color = {1, 1, 1};
    std::uint64_t seed = 111;
    for (float ior : {1.3f, 1.8f})
        for (double cosine : {0.3, 0.5, 0.8, 1.0}) {
            white.ior = ior;
            const mirtest::Moments mean =
                mean_weight(params(white), mirtest::direction(cosine, 0.0), seed++);
            CAPTURE(ior, cosine, mean.mean());
            CHECK(mirtest::mean_p_value(mean, 1.0, 2e-3) > mirtest::sidak(0.01, 8));
        }
}

TEST_CASE("reflection is reciprocal, finite and not negative") {
    mir::Random random(5, mir::Stream::test, 0);
    for (int i = 0; i < 4000; ++i) {
        Material m = material(random.next(), random.next());
        m.specular = random.next();
        m.ior = 1.0f + random.next();
        const Vec3 wi = mir::square_to_cone(random.next_2d(), 0.0f);
        const Vec3 wo = mir::square_to_cone(random.next_2d(), 0.0f);
        // Where the lobe is narrower than single precision, its flank amplifies the rounding of wi.
        m.roughness = mir::larger(m.roughness, 0.15f);
        const Rgb f = CookTorrance::eval(params(m), up, wi, wo);
        const Rgb back = CookTorrance::eval(params(m), up, wo, wi);
        REQUIRE(mir::is_finite(f));
        REQUIRE((f.r >= 0.0f && f.g >= 0.0f && f.b >= 0.0f));
        REQUIRE(f.r == Approx(back.r).epsilon(1e-5));
        REQUIRE(f.b == Approx(back.b).epsilon(1e-5));
    }
}

TEST_CASE("grazing, mirror and smallest widths stay finite") {
    for (float roughness : {0.0f, 0.01f, 1.0f})
        for (double i : {1e-7, 1e-3, 1.0})
            for (double o : {1e-7, 1e-3, 1.0})
                for (double phi : {0.0, mirtest::pi, 2.0}) {
                    const CookTorrance::Params p = params(material(roughness, 1.0f));
                    const Vec3 wi = mirtest::direction(i, phi);
                    const Vec3 wo = mirtest::direction(o, 0.0);
                    CAPTURE(roughness, i, o, phi);
                    CHECK(mir::is_finite(CookTorrance::eval(p, up, wi, wo)));
                    CHECK(std::isfinite(CookTorrance::pdf(p, up, wi, wo)));
                }
}

TEST_CASE("without interface the surface is exactly Lambertian") {
    Material m = material(0.0f, 0.0f);
    m.specular = 0.0f;
    for (float roughness : {0.0f, 0.3f, 1.0f})
        for (double i : {1e-3, 0.4, 1.0})
            for (double o : {1e-3, 0.7, 1.0}) {
                m.roughness = roughness;
                const Rgb f = CookTorrance::eval(params(m), up, mirtest::direction(i, 0.2),
                                                 mirtest::direction(o, 3.0));
                CHECK(f == m.base_color * mir::inv_pi);
                CHECK(CookTorrance::specular_share(params(m), static_cast<float>(o)) == 0.0f);
            }
    const Vec3 wo = mirtest::direction(0.5, 0.0);
    CHECK(CookTorrance::albedo(params(m), up, wo) == m.base_color);
}

TEST_CASE("albedo() of a smooth interface is the directional albedo and never leaves 0 to 1") {
    for (float metallic : {0.0f, 0.4f, 1.0f})
        for (double cosine : {0.0, 0.2, 0.6, 1.0}) {
            const Vec3 wo = mirtest::direction(cosine, 0.0);
            const CookTorrance::Params p = params(material(0.1f, metallic));
            const Rgb a = CookTorrance::albedo(p, up, wo);
            CHECK((a.r <= 1.000001f && a.b >= 0.0f));
            if (cosine > 0.1)
                CHECK(mean_weight(p, wo, 6).mean() ==
                      Approx(static_cast<double>(a.g)).epsilon(0.01));
        }
}
