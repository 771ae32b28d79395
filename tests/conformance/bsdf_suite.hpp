// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/direction_grid.hpp"
#include "conformance/worlds.hpp"
#include "mir/concepts/bsdf.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

// The axioms of Bsdf, for a list of parameters that should cover the corners of the model.

namespace mirtest {

/// A unit normal that is not an axis, so that frames are exercised.
inline const mir::Vec3 slanted_normal = glm::normalize(mir::Vec3(0.3f, -0.5f, 0.8f));

/// Unit direction at cos(theta) from slanted_normal and azimuth phi.
inline mir::Vec3 at_angle(float cos_theta, float phi) {
    const float s = std::sqrt(mir::larger(0.0f, 1.0f - cos_theta * cos_theta));
    return mir::Frame::around(slanted_normal)
        .to_world({s * std::cos(phi), s * std::sin(phi), cos_theta});
}

/// Cosines from normal to grazing incidence.
inline constexpr float suite_cosines[] = {1.0f, 0.999f, 0.9f, 0.7f, 0.4f, 0.15f, 0.03f};
/// The same, and beyond what any quadrature resolves.
inline constexpr float grazing_cosines[] = {1.0f, 0.7f, 0.1f, 1e-2f, 1e-4f, 1e-6f, 1e-9f, 0.0f};

/// The solid angle that quadrature leaves out, and its error in lobes as narrow as 1e-3.
inline constexpr double quadrature_tolerance = 4e-3;

inline bool is_radiance(mir::Rgb c) {
    return mir::is_finite(c) && c.r >= 0.0f && c.g >= 0.0f && c.b >= 0.0f;
}

/// Axiom 1: finite and not negative, up to grazing angles and for directions that oppose each
/// other.
template <mir::Bsdf B>
void bsdf_is_finite(const typename B::Params& p) {
    std::size_t bad = 0;
    for (float cos_i : grazing_cosines)
        for (float cos_o : grazing_cosines)
            for (float phi : {0.0f, 1e-4f, 1.0f, 3.0f, mir::pi}) {
                const mir::Vec3 wi = at_angle(cos_i, phi);
                const mir::Vec3 wo = at_angle(cos_o, 0.0f);
                bad += is_radiance(B::eval(p, slanted_normal, wi, wo)) ? 0 : 1;
                const float pdf = B::pdf(p, slanted_normal, wi, wo);
                bad += std::isfinite(pdf) && pdf >= 0.0f ? 0 : 1;
            }
    CHECK(bad == 0);
}

/// Axiom 1: reciprocal to a relative 1e-5.
template <mir::Bsdf B>
void bsdf_is_reciprocal(const typename B::Params& p) {
    mir::Random random = test_random(31);
    float worst = 0.0f;
    for (int i = 0; i < 2000; ++i) {
        const float cos_i = random.next();
        const mir::Vec3 wi = at_angle(cos_i, 0.0f);
        const float cos_o = random.next();
        const mir::Vec3 wo = at_angle(cos_o, 2.0f * mir::pi * random.next());
        const mir::Rgb there = B::eval(p, slanted_normal, wi, wo);
        const mir::Rgb back = B::eval(p, slanted_normal, wo, wi);
        for (const auto& [a, b] :
             {std::pair{there.r, back.r}, {there.g, back.g}, {there.b, back.b}})
            if (a != b) worst = std::max(worst, std::fabs(a - b) / std::max(a, b));
    }
    CHECK(worst < 1e-5f);
}

/// Directional albedo towards `wo`, and what pdf() integrates to, by quadrature around the mirrored
/// direction.
struct Integrals {
    double albedo = 0.0;  ///< largest channel
    double pdf = 0.0;
};

template <mir::Bsdf B>
Integrals integrate(const typename B::Params& p, mir::Vec3 wo) {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
    Integrals sum;
    const mir::Vec3 mirrored = 2.0f * glm::dot(wo, slanted_normal) * slanted_normal - wo;
    for_each_direction_around(mirrored, 300, 96, [&](mir::Vec3 wi, double solid_angle) {
        const float cosine = glm::dot(wi, slanted_normal);
        if (cosine <= 0.0f) return;
        const mir::Rgb f = B::eval(p, slanted_normal, wi, wo);
        const double weight = solid_angle * static_cast<double>(cosine);
        red += f.r * weight;
        green += f.g * weight;
        blue += f.b * weight;
        sum.pdf += solid_angle * B::pdf(p, slanted_normal, wi, wo);
    });
    sum.albedo = std::max(red, std::max(green, blue));
    return sum;
}

/// Axioms 2 and 4: reflects at most what arrives; pdf() integrates to at most 1.
template <mir::Bsdf B>
void bsdf_keeps_energy(const typename B::Params& p) {
    for (float cosine : suite_cosines) {
        const Integrals sum = integrate<B>(p, at_angle(cosine, 0.4f));
        INFO("cosine " << cosine);
        CHECK(sum.albedo <= 1.0 + quadrature_tolerance);
        CHECK(sum.pdf <= 1.0 + quadrature_tolerance);
    }
}

/// Axiom 3. A millionth for rounding.
template <mir::Bsdf B>
void bsdf_albedo_is_a_share(const typename B::Params& p) {
    for (float cosine : grazing_cosines) {
        const mir::Rgb albedo = B::albedo(p, slanted_normal, at_angle(cosine, 0.4f));
        CHECK(is_radiance(albedo));
        CHECK(mir::max_channel(albedo) <= 1.0f + 1e-6f);
    }
}

/// Axiom 3: what calls itself black reflects nothing in any direction.
template <mir::Bsdf B>
void black_reflects_nothing(const typename B::Params& p) {
    if (!B::is_black(p)) return;
    for (float cos_i : suite_cosines)
        for (float cos_o : suite_cosines)
            CHECK(mir::is_black(
                B::eval(p, slanted_normal, at_angle(cos_i, 1.0f), at_angle(cos_o, 0.4f))));
}

/// Axiom 4: weights are eval cos / pdf, to 1e-4 because narrow lobes magnify the rounding of wi.
template <mir::Bsdf B>
void bsdf_weights_are_right(const typename B::Params& p) {
    mir::Random random = test_random(32);
    std::size_t kept = 0;
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const mir::Vec3 wo = at_angle(suite_cosines[i % 7], 0.4f);
        const mir::Vec2 u = random.next_2d();
        const mir::BsdfSample s = B::sample(p, slanted_normal, wo, u, random.next());
        REQUIRE(is_radiance(s.weight));
        if (mir::is_black(s.weight)) continue;
        ++kept;
        REQUIRE(glm::length(s.wi) == Approx(1.0f).epsilon(1e-4));
        const float cosine = glm::dot(s.wi, slanted_normal);
        REQUIRE(cosine > 0.0f);
        REQUIRE(s.pdf > 0.0f);
        const double pdf = B::pdf(p, slanted_normal, s.wi, wo);
        const mir::Rgb f = B::eval(p, slanted_normal, s.wi, wo);
        const double wanted = static_cast<double>(mir::luminance(f)) * cosine / pdf;
        worst = std::max(worst, std::fabs(mir::luminance(s.weight) / wanted - 1.0));
        worst = std::max(worst, std::fabs(s.pdf / pdf - 1.0));
    }
    CHECK(worst < 1e-4);
    if (mir::max_channel(B::albedo(p, slanted_normal, slanted_normal)) > 0.0f) CHECK(kept > 2000);
}

/// Axiom 4: sample() follows pdf(). Hypothesis: the counts of 20 000 samples in 6 x 8 cells of
/// (cos, azimuth), and of those thrown away, have the probabilities that quadrature of pdf() gives.
/// Pearson's chi-squared at level 1e-6 (Wilson and Hilferty's approximation, quantile 4.75);
/// seed fixed in test_random(). Lobes must be wider than the grid's cells.
template <mir::Bsdf B>
void bsdf_samples_follow_pdf(const typename B::Params& p, float cosine) {
    const mir::Vec3 wo = at_angle(cosine, 0.4f);
    const mir::Frame frame = mir::Frame::around(slanted_normal);
    const auto cell = [&](mir::Vec3 wi) {
        const mir::Vec3 local = frame.to_local(wi);
        const float turn = std::atan2(local.y, local.x) / (2.0f * mir::pi) + 0.5f;
        const int across = std::clamp(static_cast<int>(turn * 8.0f), 0, 7);
        return std::clamp(static_cast<int>(local.z * 6.0f), 0, 5) * 8 + across;
    };
    std::vector<double> wanted(49, 0.0);
    for_each_direction_around(slanted_normal, 1200, 960, [&](mir::Vec3 wi, double solid_angle) {
        if (glm::dot(wi, slanted_normal) > 0.0f)
            wanted[cell(wi)] += solid_angle * B::pdf(p, slanted_normal, wi, wo);
    });
    constexpr int samples = 20000;
    wanted[48] = 1.0 - std::accumulate(wanted.begin(), wanted.end() - 1, 0.0);
    std::vector<double> found(49, 0.0);
    mir::Random random = test_random(33);
    for (int i = 0; i < samples; ++i) {
        const mir::Vec2 u = random.next_2d();
        const mir::BsdfSample s = B::sample(p, slanted_normal, wo, u, random.next());
        found[s.pdf > 0.0f ? cell(s.wi) : 48] += 1.0;
    }
    double chi_squared = 0.0;
    int cells = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const double expected = wanted[i] * samples;
        if (expected < 8.0) continue;
        chi_squared += (found[i] - expected) * (found[i] - expected) / expected;
        ++cells;
    }
    const double freedom = cells - 1.0;
    const double spread = 2.0 / (9.0 * freedom);
    const double normal = (std::cbrt(chi_squared / freedom) - (1.0 - spread)) / std::sqrt(spread);
    INFO("chi-squared " << chi_squared << " of " << freedom << " degrees of freedom");
    CHECK(normal < 4.75);
}

/// Everything but the statistical axiom.
template <mir::Bsdf B>
void bsdf_suite(std::span<const typename B::Params> list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        INFO("parameters " << i);
        bsdf_is_finite<B>(list[i]);
        bsdf_is_reciprocal<B>(list[i]);
        bsdf_keeps_energy<B>(list[i]);
        bsdf_albedo_is_a_share<B>(list[i]);
        black_reflects_nothing<B>(list[i]);
        bsdf_weights_are_right<B>(list[i]);
    }
}

}  // namespace mirtest
