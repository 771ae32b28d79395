// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rounding.hpp"
#include "mir/core/unit_circle.hpp"
#include "mir/scene/see_through.hpp"

namespace mir {

/// GGX distribution of microfacet normals, per steradian: int D cos(theta_h) dw = 1.
/// Source: Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007.
MIR_HD inline float ggx_d(float cos_h, float alpha) {
    const float a2 = alpha * alpha;
    // 1 - cos^2 + a^2 cos^2, written so that a narrow lobe keeps its digits near the normal.
    const float sin2 = (1.0f - cos_h) * (1.0f + cos_h);
    const float t = sin2 + a2 * cos_h * cos_h;
    return a2 / (pi * t * t);
}

/// wi + wo; only lengths of it are needed. Nothing is divided before GgxOutgoing::dv() divides
/// once.
template <class Rounding>
struct HalfVector {
    float along = 0.0f;           ///< its component along the normal: n.wi + n.wo
    float across_squared = 0.0f;  ///< the square of the rest, with all digits for narrow lobes

    /// `along` is n.wi + n.wo, at least GgxOutgoing::least_cosine.
    [[nodiscard, gnu::always_inline]] MIR_HD static HalfVector of(Vec3 n, Vec3 wi, Vec3 wo,
                                                                  float along) {
        const Vec3 across = mul_add<Rounding>(-along, n, wi + wo);
        return {along, dot<Rounding>(across, across)};
    }

    /// |wi + wo|^2, up to 4.
    [[nodiscard, gnu::always_inline]] MIR_HD float squared() const {
        return Rounding::mul_add(along, along, across_squared);
    }
    /// 2 - 2 cos of the angle between it and either direction.
    [[nodiscard, gnu::always_inline]] MIR_HD float twice_versine() const {
        return 2.0f - strict::usual_sqrt(squared());
    }
};

/// GGX reflection towards one direction. What does not depend on where light comes from is found
/// once. `Rounding` is that of its sums of products (core/rounding.hpp).
template <class Rounding>
struct GgxOutgoing {
    /// Smaller cosines of wo count as this one. All that is divided by then stays in range, from
    /// 2^-105 to 2^40, without a comparison for each direction of light.
    static constexpr float least_cosine = 1e-5f;

    float cos_o = 1.0f;      ///< n.wo
    float alpha2 = 1.0f;     ///< alpha^2
    float rest = 0.0f;       ///< 1 - alpha^2
    float root_part = 1.0f;  ///< of Smith's term for wo, the root over alpha^2 / (2 pi)
    float cos_part = 1.0f;   ///< n.wo over the same

    /// `alpha` is not below min_ggx_alpha.
    [[nodiscard, gnu::always_inline]] MIR_HD static GgxOutgoing of(float n_wo, float alpha) {
        const float cos_o = larger(n_wo, least_cosine);
        const float a2 = alpha * alpha;
        const float rest = 1.0f - a2;
        const float part = strict::usual_reciprocal(a2 * (0.5f * inv_pi));
        return {cos_o, a2, rest, part * smith_root(cos_o, a2, rest), part * cos_o};
    }

    /// pi / alpha^2 over this is height-correlated Smith masking and shadowing over 4 (n.wi)(n.wo).
    /// `cos_i` is n.wi, not negative. Source: Heitz, "Understanding the masking-shadowing
    /// function", JCGT 3(2), 2014, eq. 99.
    [[nodiscard, gnu::always_inline]] MIR_HD float smith_sum(float cos_i) const {
        return Rounding::mul_add(cos_i, root_part, cos_part * smith_root(cos_i, alpha2, rest));
    }

    /// D V: ggx_d() times masking and shadowing over 4 (n.wi)(n.wo), per steradian. With h the half
    /// vector, cos^2 = along^2 / h^2 and sin^2 = across^2 / h^2, so
    /// D = a^2 h^4 / (pi (across^2 + a^2 along^2)^2). `cos_i` is not negative.
    [[nodiscard, gnu::always_inline]] MIR_HD float dv(const HalfVector<Rounding>& half,
                                                      float cos_i) const {
        const float spread =
            Rounding::mul_add(alpha2, half.along * half.along, half.across_squared);
        const float squared = half.squared();
        return squared * squared * strict::usual_reciprocal(spread * spread * smith_sum(cos_i));
    }

 private:
    [[nodiscard, gnu::always_inline]] MIR_HD static float smith_root(float cosine, float alpha2,
                                                                     float rest) {
        return strict::usual_sqrt(Rounding::mul_add(cosine * cosine, rest, alpha2));
    }
};

/// Smith masking of one direction, G1 in [0, 1].
MIR_HD inline float ggx_g1(float cos_theta, float alpha) {
    const float a2 = alpha * alpha;
    return 2.0f * cos_theta / (cos_theta + sqrtf(cos_theta * cos_theta * (1.0f - a2) + a2));
}

/// Density, per steradian of wi, of ggx_sample_reflection(): G1(wo) D / (4 n.wo).
MIR_HD inline float ggx_reflection_pdf(float cos_o, float cos_h, float alpha) {
    return ggx_g1(cos_o, alpha) * ggx_d(smaller(cos_h, 1.0f), alpha) / (4.0f * cos_o);
}

/// A microfacet normal drawn among those visible from `wo`. Local frame, n = +z. Its density is
/// G1(wo) (wo.h) D(h) / wo.n. Source: Dupuy and Benyoub, "Sampling visible GGX normals with
/// spherical caps", HPG 2023.
MIR_HD inline Vec3 ggx_sample_normal(Vec3 wo, float alpha, Vec2 u) {
    const Vec3 stretched = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
    const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const float s = sqrtf(smaller(larger(1.0f - z * z, 0.0f), 1.0f));
    const Vec3 half = Vec3(s * unit_circle(u.x), z) + stretched;
    return glm::normalize(Vec3(alpha * half.x, alpha * half.y, larger(half.z, 0.0f)));
}

/// Mirrors `wo` at a microfacet normal drawn among those visible from it. Local frame, n = +z.
MIR_HD inline Vec3 ggx_sample_reflection(Vec3 wo, float alpha, Vec2 u) {
    const Vec3 h = ggx_sample_normal(wo, alpha, u);
    return 2.0f * glm::dot(wo, h) * h - wo;
}

}  // namespace mir
