// SPDX-License-Identifier: MIT
#include "mir/shading/ggx.hpp"

#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;
using mirtest::Histogram;
using mirtest::pi;

// Normals are placed on the unit square by q with t^2 = 1 / (1 - q)^2 - 1, t = tan(theta) / alpha,
// and their azimuth: there densities of normals are bounded and smooth, so narrow lobes need no
// finer cells.
double cosine_at(double q, double alpha) {
    const double rest = 1.0 - q;
    return rest / std::sqrt(rest * rest + alpha * alpha * (1.0 - rest * rest));
}
double steradians_at(double q, double alpha) {
    const double rest = 1.0 - q;
    const double w = rest * rest + alpha * alpha * (1.0 - rest * rest);
    return 2 * pi * alpha * alpha / (w * std::sqrt(w));
}

/// int over the hemisphere of normals of f(h) in steradians.
template <class F>
double integrate_normals(double alpha, const F& f) {
    return mirtest::integrate(0, 1, 0, 1, 24, [&](double q, double turn) {
        const Vec3 h = mirtest::direction(cosine_at(q, alpha), 2 * pi * turn);
        return steradians_at(q, alpha) * f(h);
    });
}

double distribution(Vec3 h, double alpha) {
    return static_cast<double>(mir::ggx_d(h.z, static_cast<float>(alpha)));
}

/// Density of the normals behind ggx_sample_reflection(), from its density of directions.
double density_of_normal(Vec3 h, Vec3 wo, float alpha) {
    const auto cosine = static_cast<double>(glm::dot(wo, h));
    if (cosine <= 0.0) return 0.0;
    return static_cast<double>(mir::ggx_reflection_pdf(wo.z, h.z, alpha)) * 4.0 * cosine;
}

struct Setting {
    float alpha;
    double cosine;  ///< of wo
};

constexpr Setting settings[] = {{0.01f, 0.9}, {0.01f, 0.1}, {0.1f, 1.0}, {0.1f, 0.5},
                                {0.1f, 0.05}, {0.4f, 0.7},  {0.4f, 0.1}, {1.0f, 0.95},
                                {1.0f, 0.4},  {1.0f, 0.05}};

/// Normals of `count` sampled reflections, by `sample(wo, alpha, u)`.
template <class Sample>
Histogram normals(Setting at, std::uint64_t seed, const Sample& sample) {
    const Vec3 wo = mirtest::direction(at.cosine, 0.7);
    const auto alpha = static_cast<double>(at.alpha);
    Histogram histogram(12, 16);
    mir::Random random(seed, mir::Stream::test, 0);
    for (int i = 0; i < 60'000; ++i) {
        const Vec3 h = glm::normalize(wo + sample(wo, at.alpha, random.next_2d()));
        const double r2 = static_cast<double>(h.x * h.x + h.y * h.y);
        const double t2 = r2 / static_cast<double>(h.z * h.z) / (alpha * alpha);
        histogram.add(1.0 - 1.0 / std::sqrt(1.0 + t2),
                      mirtest::turn(static_cast<double>(h.x), static_cast<double>(h.y)));
    }
    return histogram;
}

/// `density` on the square of q and turn, from a density per steradian.
template <class F>
auto on_square(Setting at, const F& density) {
    return [=](double q, double turn) {
        const auto alpha = static_cast<double>(at.alpha);
        const Vec3 h = mirtest::direction(cosine_at(q, alpha), 2 * pi * turn);
        return steradians_at(q, alpha) * density(h, mirtest::direction(at.cosine, 0.7), at.alpha);
    };
}

/// Smith masking and shadowing over 4 (n.wi)(n.wo), from the sum that it is the inverse of.
template <class Rounding>
float smith(const mir::GgxOutgoing<Rounding>& ggx, float cos_i, float alpha) {
    return mir::pi / (alpha * alpha * ggx.smith_sum(cos_i));
}

}  // namespace

TEST_CASE("the GGX distribution projects to unit area") {
    for (double alpha : {0.02, 0.1, 0.5, 1.0})
        CHECK(integrate_normals(alpha, [=](Vec3 h) {
                  return distribution(h, alpha) * static_cast<double>(h.z);
              }) == Approx(1.0).epsilon(2e-4));
    // At the smallest width a cosine in single precision resolves the lobe to a few percent.
    const auto smallest = static_cast<double>(mir::min_ggx_alpha);
    CHECK(integrate_normals(smallest, [=](Vec3 h) {
              return distribution(h, smallest) * static_cast<double>(h.z);
          }) == Approx(1.0).epsilon(0.05));
}

TEST_CASE("GGX at alpha 1 is the uniform distribution of normals") {
    for (float c : {0.0f, 0.3f, 1.0f}) CHECK(mir::ggx_d(c, 1.0f) == Approx(mir::inv_pi));
}

TEST_CASE("masking keeps the projected area of visible normals: weak white furnace") {
    // int G1(wo) D(h) / (4 n.wo) dwi = 1 over all mirrored directions, for each direction and
    // width.
    for (float alpha : {0.02f, 0.1f, 0.3f, 0.7f, 1.0f})
        for (double cosine : {1.0, 0.8, 0.4, 0.1, 0.02}) {
            const Vec3 wo = mirtest::direction(cosine, 0.3);
            CAPTURE(alpha, cosine);
            CHECK(integrate_normals(static_cast<double>(alpha), [&](Vec3 h) {
                      return density_of_normal(h, wo, alpha);
                  }) == Approx(1.0).epsilon(2e-4));
        }
}

TEST_CASE("the weak white furnace holds over incident directions too") {
    // The same integral without the change of variables, where the lobe is wide enough for it.
    for (float alpha : {0.5f, 1.0f})
        for (double cosine : {0.9, 0.3}) {
            const Vec3 wo = mirtest::direction(cosine, 0.3);
            CAPTURE(alpha, cosine);
            // A normal above the horizon mirrors wo to n.wi > -n.wo.
            CHECK(mirtest::integrate_directions(-cosine, 1.0, 48, [&](Vec3 wi) {
                      return mir::ggx_reflection_pdf(wo.z, glm::normalize(wi + wo).z, alpha);
                  }) == Approx(1.0).epsilon(2e-4));
        }
}

TEST_CASE("masking falls from 1 at the normal to 0 at the horizon") {
    for (float alpha : {0.01f, 0.2f, 1.0f}) {
        CHECK(mir::ggx_g1(1.0f, alpha) == Approx(1.0f));
        CHECK(mir::ggx_g1(0.0f, alpha) == 0.0f);
        for (float c = 0.05f; c < 1.0f; c += 0.05f)
            CHECK(mir::ggx_g1(c, alpha) <= mir::ggx_g1(c + 0.05f, alpha) * 1.000001f);
    }
}

TEMPLATE_TEST_CASE(
    "height-correlated shadowing is symmetric and at most the masking of either side", "",
    mir::SeparateRounding, mir::FusedRounding) {
    using Ggx = mir::GgxOutgoing<TestType>;
    for (float alpha : {0.05f, 0.4f, 1.0f})
        for (float i : {0.05f, 0.4f, 1.0f})
            for (float o : {0.05f, 0.3f, 0.9f}) {
                const float g2 = 4 * i * o * smith(Ggx::of(o, alpha), i, alpha);
                CHECK(g2 == Approx(4 * i * o * smith(Ggx::of(i, alpha), o, alpha)));
                CHECK(g2 <= std::min(mir::ggx_g1(i, alpha), mir::ggx_g1(o, alpha)) * 1.00001f);
                CHECK(g2 >= mir::ggx_g1(i, alpha) * mir::ggx_g1(o, alpha) * 0.99999f);
            }
}

// H0: mirrored directions follow ggx_reflection_pdf(). Chi-square of their normals on 12 x 16
// cells, level 1 % over all settings, seeds 21 to 30.
TEST_CASE("visible normals follow their density", "[statistical]") {
    const double level = mirtest::sidak(0.01, std::size(settings));
    std::uint64_t seed = 21;
    for (Setting at : settings) {
        const Histogram h = normals(at, seed++, mir::ggx_sample_reflection);
        CAPTURE(at.alpha, at.cosine);
        CHECK(h.against(on_square(at, density_of_normal), 4).p_value > level);
    }
}

TEST_CASE("chi-square catches a wrong lobe", "[statistical]") {
    const double level = mirtest::sidak(0.01, std::size(settings));
    const Setting at{0.4f, 0.7};
    // All normals instead of the visible ones, a width that is 3 % off, a density without masking.
    const auto all_normals = [](Vec3 wo, float alpha, Vec2 u) {
        const double q = 1.0 - std::sqrt(1.0 - static_cast<double>(u.x));
        const double cosine = cosine_at(q, static_cast<double>(alpha));
        const Vec3 h = mirtest::direction(cosine, 2 * pi * static_cast<double>(u.y));
        return 2.0f * glm::dot(wo, h) * h - wo;
    };
    CHECK(normals(at, 31, all_normals).against(on_square(at, density_of_normal), 4).p_value <
          level);
    const auto wider = [](Vec3 wo, float alpha, Vec2 u) {
        return mir::ggx_sample_reflection(wo, 1.03f * alpha, u);
    };
    CHECK(normals(at, 32, wider).against(on_square(at, density_of_normal), 4).p_value < level);
    const auto unmasked = [](Vec3 h, Vec3 wo, float alpha) {
        return density_of_normal(h, wo, alpha) / static_cast<double>(mir::ggx_g1(wo.z, alpha));
    };
    CHECK(normals(at, 33, mir::ggx_sample_reflection).against(on_square(at, unmasked), 4).p_value <
          level);
}

TEMPLATE_TEST_CASE("D V by the half vector's parts is D V by its cosine", "", mir::SeparateRounding,
                   mir::FusedRounding) {
    const Vec3 n(0, 0, 1);
    mir::Random random(41, mir::Stream::test, 0);
    for (float alpha : {0.05f, 0.4f, 1.0f})
        for (int i = 0; i < 300; ++i) {
            const Vec3 wi = mir::square_to_cosine_hemisphere(random.next_2d());
            const Vec3 wo = mir::square_to_cosine_hemisphere(random.next_2d());
            const float cos_h = glm::normalize(wi + wo).z;
            const auto half = mir::HalfVector<TestType>::of(n, wi, wo, wi.z + wo.z);
            const auto ggx = mir::GgxOutgoing<TestType>::of(wo.z, alpha);
            CHECK(1.0f - 0.5f * half.twice_versine() ==
                  Approx(glm::dot(glm::normalize(wi + wo), wo)).epsilon(1e-5));
            CHECK(ggx.dv(half, wi.z) ==
                  Approx(mir::ggx_d(cos_h, alpha) * smith(ggx, wi.z, alpha)).epsilon(1e-4));
        }
}

TEMPLATE_TEST_CASE("The narrowest lobe keeps the digits of its peak and its shoulder", "",
                   mir::SeparateRounding, mir::FusedRounding) {
    const double alpha = mir::min_ggx_alpha;
    for (double tilt : {0.0, 1.0, 3.0}) {
        const double angle =
            2 * tilt * alpha;  // of wi from the mirrored direction: twice that of h
        const double incidence = 0.6;
        const auto direction = [](double theta) {
            return Vec3(float(std::sin(theta)), 0.0f, float(std::cos(theta)));
        };
        const Vec3 wo = direction(-incidence);
        const Vec3 wi = direction(incidence + angle);
        const double tan_h = std::tan(0.5 * angle);
        const double cos_h = std::cos(0.5 * angle);
        const double ratio = 1 + tan_h * tan_h / (alpha * alpha);
        const double d =
            1 / (3.14159265358979 * alpha * alpha * std::pow(cos_h, 4) * ratio * ratio);
        const auto ggx = mir::GgxOutgoing<TestType>::of(wo.z, float(alpha));
        const double v = double(smith(ggx, wi.z, float(alpha)));
        const auto half = mir::HalfVector<TestType>::of({0, 0, 1}, wi, wo, wi.z + wo.z);
        CHECK(double(ggx.dv(half, wi.z)) == Approx(d * v).epsilon(3e-4));
    }
}

TEMPLATE_TEST_CASE("D V is finite where directions are opposite and where both graze", "",
                   mir::SeparateRounding, mir::FusedRounding) {
    const Vec3 n(0, 0, 1);
    for (float alpha : {mir::min_ggx_alpha, 1.0f})
        for (float z : {-1e-3f, 0.0f, 1e-12f, 1e-6f}) {
            const Vec3 wi(1, 0, z);
            const auto ggx = mir::GgxOutgoing<TestType>::of(z, alpha);
            const float cos_i = std::max(z, 0.0f);
            for (const Vec3 wo : {Vec3(-1, 0, z), Vec3(1, 0, z), Vec3(0, 1, z)}) {
                const auto half = mir::HalfVector<TestType>::of(n, wi, wo, cos_i + ggx.cos_o);
                const float dv = ggx.dv(half, cos_i);
                CHECK(std::isfinite(dv));
                CHECK(std::isfinite(half.twice_versine()));
                CHECK(dv >= 0.0f);
            }
        }
}
