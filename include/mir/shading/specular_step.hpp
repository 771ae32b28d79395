// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/shading/specular_surface.hpp"

namespace mir {

/// What a ray does at a surface where it may go on.
enum class SpecularEvent : std::uint8_t {
    stop,      ///< the surface is the end of the chain
    pass,      ///< straight on
    mirror,    ///< reflected
    transmit,  ///< to the other side in another direction
    coat,      ///< its rough coat is the end of the chain, with a lobe of its own
    through    ///< the other side is the end of the chain: what goes through diffusely
};

/// How events are drawn and weighed.
struct SpecularRules {
    Transport transport = Transport::radiance;  ///< what the chain carries
    /// Probabilities are multiples of it, 0..0.25, or of one over the events where those are more.
    /// 0: they go by the events' shares alone.
    float least = 0.0f;
};

/// One event of a chain.
struct SpecularStep {
    SpecularEvent event = SpecularEvent::stop;  ///< drawn by specular_step()
    Vec3 direction{0};                          ///< unit, where the ray goes on
    /// Share of the event over its probability; at an end, what the Bsdf is multiplied by.
    Rgb weight{1.0f, 1.0f, 1.0f};
    float probability = 1.0f;  ///< of the event, in (0, 1]
};

namespace detail {

/// Probabilities of the events, in the ratio of their shares: all weights are alike then. With a
/// `least` they are multiples of it, one at least of each event that can be: samples that are
/// spread evenly in so many steps then have each event equally often, whatever their shift.
struct SpecularOdds {
    float stop = 0.0f;
    float pass = 0.0f;
    float mirror = 0.0f;
    float transmit = 0.0f;
    float coat = 0.0f;
    float through = 0.0f;

    /// `rest` is what the Bsdf may be worth.
    [[nodiscard]] MIR_HD static SpecularOdds of(const SpecularShares& shares, float rest,
                                                float least) {
        SpecularOdds o{rest,
                       luminance(shares.pass),
                       luminance(shares.mirrored),
                       luminance(shares.transmitted),
                       shares.coated,
                       shares.through};
        const float sum = o.sum();
        if (!(sum > 0.0f)) return {};
        float* const odds[] = {&o.stop, &o.pass, &o.mirror, &o.transmit, &o.coat, &o.through};
        float* likeliest = odds[0];
        std::uint32_t events = 0;
        for (float* const odd : odds) {
            *odd = *odd > 0.0f ? *odd / sum : 0.0f;
            events += *odd > 0.0f ? 1 : 0;
            if (*odd > *likeliest) likeliest = odd;
        }
        if (least > 0.0f) o.share_out(events, likeliest, static_cast<std::uint32_t>(1.01f / least));
        // What rounding leaves, too.
        *likeliest -= o.sum() - 1.0f;
        return o;
    }

    /// Makes multiples of 1 / `steps` of all but the likeliest, which takes the rest: one step at
    /// least, as no other has more than its share of those that are left.
    MIR_HD void share_out(std::uint32_t events, const float* likeliest, std::uint32_t steps) {
        const std::uint32_t all = events > steps ? events : steps;
        const auto left = static_cast<float>(all - events);
        const float step = 1.0f / static_cast<float>(all);
        for (float* const odd : {&stop, &pass, &mirror, &transmit, &coat, &through})
            if (odd != likeliest && *odd > 0.0f)
                *odd = step * (1.0f + static_cast<float>(static_cast<std::uint32_t>(left * *odd)));
    }

    [[nodiscard]] MIR_HD float sum() const {
        return stop + pass + mirror + transmit + coat + through;
    }
};

/// Direction behind an interface of index `eta` with normal `n`, on the side of `wo`. Zero where
/// all light is reflected.
[[nodiscard]] MIR_HD inline Vec3 refracted(Vec3 wo, Vec3 n, float eta) {
    const float cosine = glm::dot(wo, n);
    const float sin2 = (1.0f - cosine * cosine) / (eta * eta);
    if (sin2 >= 1.0f) return Vec3(0.0f);
    return glm::normalize((cosine / eta - sqrtf(1.0f - sin2)) * n - wo / eta);
}

/// Direction of a mirror, or the mirrored one of the geometric normal where that runs into the
/// surface.
[[nodiscard]] MIR_HD inline Vec3 mirrored(const SpecularSurface& s, Vec3 h) {
    const Vec3 w = 2.0f * glm::dot(s.wo, h) * h - s.wo;
    if (glm::dot(w, s.geometric_normal) > 0.0f) return w;
    return 2.0f * glm::dot(s.wo, s.geometric_normal) * s.geometric_normal - s.wo;
}

/// A transmitted direction through the microfacet `h`. A rough sheet spreads light as its lobe
/// would reflect it, to the other side.
[[nodiscard]] MIR_HD inline Vec3 transmitted(const SpecularSurface& s, Vec3 h) {
    if (s.bounds_body()) return refracted(s.wo, h, s.eta());
    const Vec3 w = 2.0f * glm::dot(s.wo, h) * h - s.wo;
    return w - 2.0f * glm::dot(w, s.normal) * s.normal;
}

/// Turns a rough event: draws a microfacet and corrects the weight, which is that of the normal.
template <class Numbers>
MIR_HD void roughen(const SpecularSurface& s, Numbers& numbers, SpecularStep& step) {
    const float alpha = s.factors.roughness * s.factors.roughness;
    const Frame frame = Frame::around(s.normal);
    const float u = numbers.next();
    const Vec3 wo = frame.to_local(s.wo);
    const Vec3 h = frame.to_world(ggx_sample_normal(wo, alpha, {u, numbers.next()}));
    const bool is_mirror = step.event == SpecularEvent::mirror;
    step.direction = is_mirror ? 2.0f * glm::dot(s.wo, h) * h - s.wo : transmitted(s, h);
    const float cosine = glm::dot(step.direction, s.normal) * (is_mirror ? 1.0f : -1.0f);
    const float there = glm::dot(step.direction, s.geometric_normal) * (is_mirror ? 1.0f : -1.0f);
    if (!(cosine > 0.0f) || !(there > 0.0f)) {
        step.weight = {};
        return;
    }
    const float facet = glm::dot(s.wo, h);
    const float at_glass = s.dielectric(facet);
    const Rgb share = is_mirror ? s.mirror(at_glass, facet)
                                : s.factors.base_color * (s.clear() * (1.0f - at_glass));
    step.weight = share * (s.cover * ggx_g1(cosine, alpha) / step.probability);
}

/// The share of a coat, drawn with the probability `odds`: what it mirrors, or its own lobe.
[[nodiscard]] MIR_HD inline SpecularStep coat_step(const SpecularSurface& s, float share,
                                                   float odds) {
    const bool smooth = is_smooth(s.factors.clearcoat_roughness);
    const float weight = (smooth ? share : s.cover) / odds;
    if (!smooth) return {SpecularEvent::coat, Vec3(0.0f), {weight, weight, weight}, odds};
    return {SpecularEvent::mirror, mirrored(s, s.coat_normal), {weight, weight, weight}, odds};
}

}  // namespace detail

/// Draws what a ray does at a surface, by the luminance of the shares. `albedo` is that of the
/// Bsdf there, or what else the end of a chain is worth, 0..1. Numbers are drawn as they are
/// needed: `numbers.next()` in [0, 1). Source of rough transmission: Walter et al., "Microfacet
/// models for refraction through rough surfaces", EGSR 2007.
template <class Numbers>
[[nodiscard]] MIR_HD SpecularStep specular_step(const SpecularSurface& s, float albedo,
                                                SpecularRules rules, Numbers& numbers) {
    const SpecularShares shares = specular_shares(s);
    const detail::SpecularOdds odds =
        detail::SpecularOdds::of(shares, shares.rest * albedo, rules.least);
    float u = numbers.next();
    const auto take = [&u](float odd) {
        const bool taken = u < odd;
        u -= odd;
        return taken;
    };
    if (take(odds.pass))
        return {SpecularEvent::pass, -s.wo, shares.pass * (1.0f / odds.pass), odds.pass};
    SpecularStep step;
    const bool smooth = is_smooth(s.factors.roughness);
    if (take(odds.mirror)) {
        step = {SpecularEvent::mirror, detail::mirrored(s, s.normal),
                shares.mirrored * (1.0f / odds.mirror), odds.mirror};
        if (!smooth) detail::roughen(s, numbers, step);
        return step;
    }
    if (take(odds.transmit)) {
        step = {SpecularEvent::transmit, detail::transmitted(s, s.normal),
                shares.transmitted * (1.0f / odds.transmit), odds.transmit};
        if (!smooth) detail::roughen(s, numbers, step);
        if (s.bounds_body() && rules.transport == Transport::radiance)
            step.weight = step.weight * (1.0f / (s.eta() * s.eta()));
        return step;
    }
    if (take(odds.coat)) return detail::coat_step(s, shares.coated, odds.coat);
    if (take(odds.through)) {
        const float weight = s.cover / odds.through;
        return {SpecularEvent::through, Vec3(0.0f), {weight, weight, weight}, odds.through};
    }
    if (odds.stop > 0.0f) {
        const float rest = shares.rest / odds.stop;
        return {SpecularEvent::stop, Vec3(0.0f), Rgb{rest, rest, rest}, odds.stop};
    }
    step.weight = {};
    return step;
}

}  // namespace mir
