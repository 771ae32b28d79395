// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/core/number_text.hpp"
#include "mir/validation/detail/bsdf_directions.hpp"
#include "mir/validation/detail/direction_grid.hpp"
#include "mir/validation/detail/random.hpp"
#include "mir/validation/detail/same_pixels.hpp"
#include "mir/validation/detail/worse.hpp"
#include "mir/validation/report.hpp"

#include <algorithm>
#include <span>

namespace mir::validation {

namespace detail {

/// Axiom 1: finite and not negative, up to grazing and opposed
/// directions.
template <Bsdf B>
void expect_finite(const typename B::Params& p, Report& report) {
    std::size_t bad = 0;
    for (float cos_i : grazing_cosines)
        for (float cos_o : grazing_cosines)
            for (float phi : {0.0f, 1e-4f, 1.0f, 3.0f, pi}) {
                const Vec3 wi = at_angle(cos_i, phi);
                const Vec3 wo = at_angle(cos_o, 0.0f);
                bad += is_radiance(B::eval(p, slanted_normal, wi, wo)) ? 0 : 1;
                const float pdf = B::pdf(p, slanted_normal, wi, wo);
                bad += std::isfinite(pdf) && pdf >= 0.0f ? 0 : 1;
            }
    report.expect(bad == 0, "eval and pdf are finite and not negative",
                  std::to_string(bad) + " of 640 values are not");
}

/// Axiom 1: reciprocal to a relative 1e-5.
template <Bsdf B>
void expect_reciprocal(const typename B::Params& p, Report& report) {
    Random random = numbers(31);
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const float cos_i = random.next();
        const Vec3 wi = at_angle(cos_i, 0.0f);
        const float cos_o = random.next();
        const Vec3 wo = at_angle(cos_o, 2.0f * pi * random.next());
        const Rgb there = B::eval(p, slanted_normal, wi, wo);
        const Rgb back = B::eval(p, slanted_normal, wo, wi);
        for (const auto& [a, b] :
             {std::pair{there.r, back.r}, {there.g, back.g}, {there.b, back.b}})
            if (a != b)
                worst = worse(worst, std::fabs(a - b) / std::max(std::fabs(a), std::fabs(b)));
    }
    report.expect(
        worst < 1e-5, "eval is reciprocal",
        "eval(wi, wo) and eval(wo, wi) differ by up to " + number_text(worst) + " of the larger");
}

/// The prepared model is the same in every bit. With fused sums of products it is so to a relative
/// 1e-3, which is what narrow lobes lose anyway.
template <PreparedBsdf B>
void expect_same_when_prepared(const typename B::Params& p, Report& report) {
    Random random = numbers(33);
    std::size_t different = 0;
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 wi = at_angle(random.next(), 0.0f);
        const float cos_o = random.next();
        const Vec3 wo = at_angle(cos_o, 2.0f * pi * random.next());
        const float cos_i = glm::dot(slanted_normal, wi);
        const Rgb plain = B::eval(p, slanted_normal, wi, wo);
        const Rgb prepared =
            B::template outgoing<SeparateRounding>(p, slanted_normal, wo)(wi, cos_i);
        different += bits_of(plain) == bits_of(prepared) ? 0 : 1;
        const Rgb fused = B::template outgoing<FusedRounding>(p, slanted_normal, wo)(wi, cos_i);
        for (const auto& [a, b] :
             {std::pair{plain.r, fused.r}, {plain.g, fused.g}, {plain.b, fused.b}})
            if (a != b)
                worst = worse(worst, std::fabs(a - b) / std::max(std::fabs(a), std::fabs(b)));
    }
    report.expect(different == 0, "prepared, it is the same in every bit",
                  std::to_string(different) + " of 2000 values are not");
    report.expect(worst < 1e-3, "rounded otherwise, it is the same function",
                  "values differ by up to " + number_text(worst) + " of the larger");
}

/// Directional albedo towards `wo`, and what pdf() integrates to, by quadrature around the mirrored
/// direction.
struct BsdfIntegrals {
    double albedo = 0.0;  ///< largest channel
    double pdf = 0.0;
};

template <Bsdf B>
BsdfIntegrals integrate(const typename B::Params& p, Vec3 wo) {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
    BsdfIntegrals sum;
    const Vec3 mirrored = 2.0f * glm::dot(wo, slanted_normal) * slanted_normal - wo;
    for_each_direction_around(mirrored, 300, 96, [&](Vec3 wi, double solid_angle) {
        const float cosine = glm::dot(wi, slanted_normal);
        if (cosine <= 0.0f) return;
        const Rgb f = B::eval(p, slanted_normal, wi, wo);
        const double weight = solid_angle * static_cast<double>(cosine);
        red += f.r * weight;
        green += f.g * weight;
        blue += f.b * weight;
        sum.pdf += solid_angle * B::pdf(p, slanted_normal, wi, wo);
    });
    sum.albedo = worse(red, worse(green, blue));
    return sum;
}

/// Axioms 2 and 4: reflects at most what arrives; pdf() integrates to at most 1. The tolerance is
/// the solid angle that quadrature leaves out, and its error in lobes as narrow as 1e-3.
template <Bsdf B>
void expect_energy(const typename B::Params& p, Report& report) {
    constexpr double most = 1.0 + 4e-3;
    for (float cosine : usual_cosines) {
        const BsdfIntegrals sum = integrate<B>(p, at_angle(cosine, 0.4f));
        const std::string at = " at a cosine of " + number_text(cosine);
        report.expect(sum.albedo <= most, "no more light is reflected than arrives",
                      number_text(sum.albedo) + " of it" + at);
        report.expect(sum.pdf <= most, "pdf integrates to at most 1",
                      "it gives " + number_text(sum.pdf) + at);
    }
}

/// Axiom 3: albedo is a share, and a black model reflects nothing. A millionth is left for
/// rounding.
template <Bsdf B>
void expect_albedo(const typename B::Params& p, Report& report) {
    std::size_t bad = 0;
    for (float cosine : grazing_cosines) {
        const Rgb albedo = B::albedo(p, slanted_normal, at_angle(cosine, 0.4f));
        bad += is_radiance(albedo) && max_channel(albedo) <= 1.0f + 1e-6f ? 0 : 1;
    }
    report.expect(bad == 0, "albedo lies in [0, 1]",
                  "not at " + std::to_string(bad) + " of 8 angles");
    if (!B::is_black(p)) return;
    std::size_t lit = 0;
    for (float cos_i : usual_cosines)
        for (float cos_o : usual_cosines)
            lit +=
                is_black(B::eval(p, slanted_normal, at_angle(cos_i, 1.0f), at_angle(cos_o, 0.4f)))
                    ? 0
                    : 1;
    report.expect(lit == 0, "what is black reflects nothing",
                  "it does in " + std::to_string(lit) + " of 49 pairs of directions");
}

/// Axiom 4: weights are eval cos / pdf, to 1e-4. Narrow lobes magnify the rounding of wi.
template <Bsdf B>
void expect_weights(const typename B::Params& p, Report& report) {
    Random random = numbers(32);
    std::size_t kept = 0;
    std::size_t bad = 0;
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 wo = at_angle(usual_cosines[i % 7], 0.4f);
        const Vec2 u = random.next_2d();
        const BsdfSample s = B::sample(p, slanted_normal, wo, u, random.next());
        if (is_radiance(s.weight) && is_black(s.weight)) continue;
        const float cosine = glm::dot(s.wi, slanted_normal);
        if (!is_radiance(s.weight) || !(std::fabs(glm::length(s.wi) - 1.0f) <= 1e-4f) ||
            !(cosine > 0.0f) || !(s.pdf > 0.0f)) {
            ++bad;
            continue;
        }
        ++kept;
        const double pdf = B::pdf(p, slanted_normal, s.wi, wo);
        const Rgb f = B::eval(p, slanted_normal, s.wi, wo);
        const double wanted = static_cast<double>(luminance(f)) * cosine / pdf;
        worst = worse(worst, std::fabs(luminance(s.weight) / wanted - 1.0));
        worst = worse(worst, std::fabs(s.pdf / pdf - 1.0));
    }
    report.expect(bad == 0, "samples are unit directions above the surface with finite weights",
                  std::to_string(bad) + " of 4000 are not");
    report.expect(worst < 1e-4, "weights of samples are eval cos / pdf",
                  "they differ by up to " + number_text(worst) + " of it");
    if (max_channel(B::albedo(p, slanted_normal, slanted_normal)) > 0.0f)
        report.expect(kept > 2000, "samples of what reflects are mostly kept",
                      std::to_string(4000 - kept) + " of 4000 are thrown away");
}

/// Largest difference of a channel.
inline float apart(Rgb a, Rgb b) {
    const Rgb d = a - b;
    return larger(std::fabs(d.r), larger(std::fabs(d.g), std::fabs(d.b)));
}

/// True when `p` reflects alike in all directions of a grid.
template <Bsdf B>
bool reflects_alike(const typename B::Params& p) {
    const Rgb f = B::eval(p, slanted_normal, slanted_normal, slanted_normal);
    for (float cos_i : usual_cosines)
        for (float cos_o : usual_cosines) {
            const Rgb other =
                B::eval(p, slanted_normal, at_angle(cos_i, 1.0f), at_angle(cos_o, 0.4f));
            if (!(apart(f, other) <= 1e-5f * max_channel(f))) return false;
        }
    return true;
}

/// Axiom 5: towards a viewer below the normal.
template <Bsdf B>
void expect_below(const typename B::Params& p, Report& report) {
    const bool alike = reflects_alike<B>(p);
    Random random = numbers(34);
    std::size_t bad = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec3 wo = at_angle(-usual_cosines[i % 7], 0.4f);
        const Vec3 wi = at_angle(1.0f - random.next(), 2.0f * pi * random.next());
        const Rgb above = B::eval(p, slanted_normal, wi, slanted_normal);
        const Rgb below = B::eval(p, slanted_normal, wi, wo);
        const BsdfSample sample = B::sample(p, slanted_normal, wo, random.next_2d(), random.next());
        const bool reflects = B::pdf(p, slanted_normal, wi, wo) > 0.0f || !is_black(sample.weight);
        const bool is_right = alike ? apart(below, above) <= 1e-5f * max_channel(above)
                                    : is_black(below) && !reflects;
        bad += is_right ? 0 : 1;
    }
    report.expect(bad == 0, "below the normal it reflects as elsewhere, or nothing",
                  "not in " + std::to_string(bad) + " of 400 pairs of directions");
}

}  // namespace detail

/// The axioms of Bsdf, and of PreparedBsdf if `B` is one. The list of parameters should cover the
/// corners of the model: white, black, smooth, rough. All but one: that samples follow their
/// density is for check_bsdf_samples().
template <Bsdf B>
Report check_bsdf(std::span<const typename B::Params> list) {
    Report report;
    for (std::size_t i = 0; i < list.size(); ++i) {
        Report one;
        detail::expect_finite<B>(list[i], one);
        detail::expect_reciprocal<B>(list[i], one);
        detail::expect_energy<B>(list[i], one);
        detail::expect_albedo<B>(list[i], one);
        detail::expect_below<B>(list[i], one);
        detail::expect_weights<B>(list[i], one);
        if constexpr (PreparedBsdf<B>) detail::expect_same_when_prepared<B>(list[i], one);
        report.add("parameters " + std::to_string(i), one);
    }
    return report;
}

}  // namespace mir::validation
