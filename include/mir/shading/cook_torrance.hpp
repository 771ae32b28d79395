// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/rgb.hpp"
#include "mir/core/warp.hpp"
#include "mir/data/bsdf_sample.hpp"
#include "mir/shading/clearcoat.hpp"
#include "mir/shading/ggx.hpp"
#include "mir/shading/reflection_lobe.hpp"

namespace mir {

/// Cook-Torrance reflection over a diffuse base. Model of Bsdf.
///
/// Specular: F D V with D and V of shading/ggx.hpp, F by Schlick between f0 and f90.
/// Diffuse: base (1 - F(n.wi)) (1 - F(n.wo)) / (pi (1 - F_avg)), the reciprocal coupling of Kelemen
/// and Szirmay-Kalos (2001): what the interface reflects does not reach the base, so a white base
/// under a smooth interface reflects exactly all light. A Clearcoat takes its share from both on
/// the way in and on the way out. Reciprocal. The directional albedo is at most 1.0025: over a
/// rough lobe the mean of Schlick's convex term exceeds what the coupling takes away.
struct CookTorrance {
    static constexpr bool has_interface = true;  ///< smooth surfaces are mirrors

    /// Twelve words, made by material_params() so that eval() divides by no constant.
    struct Params {
        Rgb diffuse;       ///< base reflectance / (1 - F_avg), 0 for metals
        Rgb f0;            ///< reflectance at normal incidence
        float f90 = 0.0f;  ///< reflectance at grazing incidence; 0: no interface, pure Lambert
        /// GGX width, roughness squared. 0: specular chains carry what the interface reflects, and
        /// the rest is the base below it.
        float alpha = 1.0f;
        Rgb scale{1.0f, 1.0f, 1.0f};  ///< multiplies f: what a specular chain to the point leaves
        float clearcoat = 0.0f;       ///< Clearcoat::weight; its reflection is not part of f

        /// True when the interface has a lobe of its own.
        [[nodiscard]] MIR_HD bool has_lobe() const { return alpha > 0.0f; }
    };

    /// f(wi, wo), sr^-1, where `wi` lies above `n`. An interface reflects nothing below `n`.
    [[gnu::always_inline]] MIR_HD static Rgb eval(const Params& p, Vec3 n, Vec3 wi, Vec3 wo) {
        if (!reflects_towards(p, glm::dot(n, wo))) return {};
        return outgoing<SeparateRounding>(p, n, wo)(wi, glm::dot(n, wi));
    }

    /// A point and the direction towards the viewer, prepared for all directions of
    /// light.
    template <class Rounding>
    struct Outgoing {
        using Model = CookTorrance;  ///< whose reflection it is
        Vec3 n;                      ///< unit shading normal
        Vec3 wo;                     ///< unit direction away from the surface
        GgxOutgoing<Rounding> ggx;   ///< of the interface
        Rgb f0;                      ///< reflectance at normal incidence
        Rgb to_f90_by_32;            ///< what it gains to grazing incidence, over 2^5
        Rgb base;                    ///< of diffuse reflection, light at normal incidence, sr^-1
        Rgb to_grazing;              ///< what that gains (it loses) to grazing incidence, sr^-1
        float below;                 ///< share that a coat leaves of light at normal incidence
        float below_to_grazing;      ///< what that gains (it loses) to grazing incidence

        /// f(wi, wo), sr^-1; `cos_i` is n.wi.
        [[nodiscard, gnu::always_inline]] MIR_HD Rgb operator()(Vec3 wi, float cos_i) const {
            const float cosine = larger(cos_i, 0.0f);
            const auto half = HalfVector<Rounding>::of(n, wi, wo, cosine + ggx.cos_o);
            const Rgb fresnel =
                mul_add<Rounding>(fifth_power(half.twice_versine()), to_f90_by_32, f0);
            const float grazing = fifth_power(1.0f - cosine);
            const Rgb diffuse = mul_add<Rounding>(grazing, to_grazing, base);
            return mul_add<Rounding>(ggx.dv(half, cosine), fresnel, diffuse) *
                   Rounding::mul_add(grazing, below_to_grazing, below);
        }
    };

    /// Of `p` seen from `wo`, which lies above `n`.
    template <class Rounding>
    [[nodiscard, gnu::always_inline]] MIR_HD static Outgoing<Rounding> outgoing(const Params& p,
                                                                                Vec3 n, Vec3 wo) {
        const float cos_o = dot<Rounding>(n, wo);
        const Rgb white{1.0f, 1.0f, 1.0f};
        const Rgb to_f90 = Rgb{p.f90, p.f90, p.f90} - p.f0;
        const Clearcoat coat{p.clearcoat};
        const Rgb scale = p.scale * (1.0f - coat.reflectance(fifth_power(1.0f - cos_o)));
        const Rgb base =
            scale * p.diffuse * inv_pi * (white - schlick<Rounding>(p.f0, to_f90, cos_o));
        const Rgb lobe = kept_if(p.has_lobe(), scale);
        return {n,
                wo,
                GgxOutgoing<Rounding>::of(cos_o, p.has_lobe() ? p.alpha : 1.0f),
                lobe * p.f0,
                lobe * to_f90 * 0x1p-5f,
                base * (white - p.f0),
                base * (p.f0 - Rgb{p.f90, p.f90, p.f90}),
                1.0f - coat.reflectance(0.0f),
                coat.reflectance(0.0f) - coat.reflectance(1.0f)};
    }

    /// Density of sample() at `wi`, per steradian.
    MIR_HD static float pdf(const Params& p, Vec3 n, Vec3 wi, Vec3 wo);

    /// `u` picks the direction inside a lobe, `lobe` the lobe.
    /// Inlined, so that whoever wants the direction alone does not pay for its weight.
    [[gnu::always_inline]] MIR_HD static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u,
                                                           float lobe);

    /// The lobe of light from `wo` that the interface reflects. It is GGX in the angle of reflected
    /// directions, which turn by twice the angle of half vectors in the plane of incidence and by
    /// less across. None where the lobe is so wide that the cosine serves as well.
    MIR_HD static ReflectionLobe lobe(const Params& p, Vec3 n, Vec3 wo) {
        const float cos_o = glm::dot(n, wo);
        const bool is_plain = !p.has_lobe() || (p.f90 <= 0.0f && mir::is_black(p.f0));
        if (is_plain || p.alpha > 0.5f || !(cos_o > 0.0f)) return {};
        const float k = 0.5f / (p.alpha * p.alpha * larger(cos_o, 0.05f));
        return {2.0f * cos_o * n - wo, smaller(k, ReflectionLobe::largest_sharpness)};
    }

    /// A direction into the lobe that the interface reflects, which lobe() must have.
    MIR_HD static Vec3 lobe_direction(const Params& p, Vec3 n, Vec3 wo, Vec2 u) {
        const Frame frame = Frame::around(n);
        return frame.to_world(ggx_sample_reflection(frame.to_local(wo), p.alpha, u));
    }
    /// Density of lobe_direction() at `wi`, per steradian. No branches: loops over lanes ask it.
    [[gnu::always_inline]] MIR_HD static float lobe_density(const Params& p, Vec3 n, Vec3 wi,
                                                            Vec3 wo) {
        const float cos_o = glm::dot(n, wo);
        const Vec3 h = wi + wo;
        return ggx_reflection_pdf(cos_o, glm::dot(n, h) / sqrtf(length_squared(h)), p.alpha);
    }

    /// True when nothing is reflected in any direction. No branches: loops over lanes ask it.
    MIR_HD static bool is_black(const Params& p) {
        const int no_interface =
            static_cast<int>(p.f90 == 0.0f) & static_cast<int>(mir::is_black(p.f0));
        const int no_lobe = static_cast<int>(!p.has_lobe()) | no_interface;
        return ((no_lobe & static_cast<int>(mir::is_black(p.diffuse))) |
                static_cast<int>(mir::is_black(p.scale))) != 0;
    }

    /// Reflection `c` times as strong. The end of a specular chain that leaves `c` of the light
    /// has it.
    MIR_HD static Params scaled(Params p, Rgb c) {
        p.scale = p.scale * c;
        return p;
    }
    /// Without what the interface reflects: chains carry that.
    MIR_HD static Params without_lobe(Params p) {
        p.alpha = 0.0f;
        return p;
    }

    /// A clear coat alone, with a lobe.
    MIR_HD static Params coat(float weight, float roughness) {
        Params p;
        p.f0 = Rgb{1.0f, 1.0f, 1.0f} * Clearcoat{weight}.reflectance(0.0f);
        p.f90 = Clearcoat{weight}.reflectance(1.0f);
        p.alpha = roughness * roughness;
        return p;
    }

    /// Reflectance towards `wo` for guide images and samplers, 0..1. The diffuse base is exact, the
    /// interface counts without its roughness, a coat by what it takes.
    MIR_HD static Rgb albedo(const Params& p, Vec3 n, Vec3 wo) {
        const Rgb white{1.0f, 1.0f, 1.0f};
        const float cosine = larger(glm::dot(n, wo), 0.0f);
        const Rgb f = schlick(p, cosine);
        const Clearcoat coat{p.clearcoat};
        const float below = 1.0f - coat.reflectance(fifth_power(1.0f - cosine));
        const Rgb mean = p.f0 * (20.0f / 21.0f) + white * (p.f90 / 21.0f);
        const Rgb taken{coat.mean_taken(p.f0.r, p.f90), coat.mean_taken(p.f0.g, p.f90),
                        coat.mean_taken(p.f0.b, p.f90)};
        const Rgb base = p.diffuse * (white - mean - taken) * (white - f);
        return p.scale * below * (kept_if(p.has_lobe(), f * below) + base);
    }

    /// Schlick's Fresnel term between f0 and f90.
    MIR_HD static Rgb schlick(const Params& p, float cos_theta) {
        return schlick<SeparateRounding>(p.f0, Rgb{p.f90, p.f90, p.f90} - p.f0, cos_theta);
    }
    /// The same, `to_f90` being f90 - f0.
    template <class Rounding>
    [[gnu::always_inline]] MIR_HD static Rgb schlick(Rgb f0, Rgb to_f90, float cos_theta) {
        return mul_add<Rounding>(fifth_power(1.0f - cos_theta), to_f90, f0);
    }

    /// x^5, Schlick's weight of reflectance at grazing incidence where x is 1 - cos.
    MIR_HD static float fifth_power(float x) {
        const float x2 = x * x;
        return x2 * x2 * x;
    }

    /// True where f is nonzero in all directions, without an interface also below `n`.
    MIR_HD static bool reflects_towards(const Params& p, float cos_o) {
        return cos_o > 0.0f || (p.f90 <= 0.0f && mir::is_black(p.f0));
    }

    /// Probability with which sample() picks the specular lobe. It is the lobe's share of the
    /// reflected light, kept away from 0 and 1 while both lobes exist.
    MIR_HD static float specular_share(const Params& p, float cos_o) {
        if (!p.has_lobe() || (p.f90 <= 0.0f && mir::is_black(p.f0))) return 0.0f;
        const float s = luminance(schlick(p, cos_o));
        const float d = luminance(p.diffuse) * (1.0f - s);
        if (mir::is_black(p.diffuse)) return 1.0f;
        return smaller(larger(s / (s + d), 0.1f), 0.9f);
    }
};

MIR_HD inline float CookTorrance::pdf(const Params& p, Vec3 n, Vec3 wi, Vec3 wo) {
    const float cos_i = glm::dot(n, wi);
    const float cos_o = glm::dot(n, wo);
    if (cos_i <= 0.0f || !reflects_towards(p, cos_o)) return 0.0f;
    const float share = specular_share(p, cos_o);
    float density = (1.0f - share) * cosine_hemisphere_pdf(cos_i);
    if (share > 0.0f) {
        const Vec3 h = glm::normalize(wi + wo);
        density += share * ggx_reflection_pdf(cos_o, glm::dot(n, h), p.alpha);
    }
    return density;
}

MIR_HD inline BsdfSample CookTorrance::sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u,
                                              float lobe) {
    const Frame frame = Frame::around(n);
    const Vec3 local_wo = frame.to_local(wo);
    if (!reflects_towards(p, local_wo.z)) return {};
    const bool specular = lobe < specular_share(p, local_wo.z);
    const Vec3 local =
        specular ? ggx_sample_reflection(local_wo, p.alpha, u) : square_to_cosine_hemisphere(u);
    const Vec3 wi = frame.to_world(local);
    const float density = pdf(p, n, wi, wo);
    const float cos_i = glm::dot(n, wi);
    if (density <= 0.0f || cos_i <= 0.0f) return {};
    return {wi, eval(p, n, wi, wo) * (cos_i / density), density};
}

}  // namespace mir
