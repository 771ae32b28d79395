// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/random.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/sphere_cone.hpp"
#include "mir/shading/vpl_shading.hpp"

#include <cstring>
#include <type_traits>

namespace mir {

/// What a virtual spherical light adds to a luxel's radiance. The light of a VPL
/// comes from a sphere around it: J / (pi r^2) int f (n.w) (-w.n_v) dw over the cone
/// of directions in which the luxel sees the sphere, cosines cut off at 0, the
/// hemisphere around the direction to the VPL where the luxel lies inside. Far away
/// that is J f G; close by it is at most 2/3 f J / r^2, so no bound is needed, and
/// light is spread rather than removed. Visibility remains that of the VPL itself.
/// Model of Shading.
///
/// Exact for a Lambertian luxel that sees the sphere above both horizons. Else an unbiased estimate
/// by directions from the cone and as many from the BSDF, joined by the balance heuristic; its
/// numbers are a function of the seed and of both places.
/// Source: Hasan, Krivanek, Walter, Bala, "Virtual spherical lights for many-light rendering of
/// glossy scenes", SIGGRAPH Asia 2009.
template <Bsdf B>
struct VslShading {
    /// What it reads of a luxel.
    using Surface = mir::Surface<typename B::Params>;

    float radius = 0.0f;        ///< of the sphere, metres; 0: a point, without bound
    std::uint32_t samples = 8;  ///< directions from the cone, and from the BSDF, at least 1
    std::uint64_t seed = 0;     ///< of the directions

    /// False where f is zero: no ray is worth its while.
    [[nodiscard]] MIR_HD bool reflects(const Surface& s) const { return !B::is_black(s.bsdf); }

    /// Radiance towards the viewer, W m^-2 sr^-1; 0 unless each faces the other's place.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface& s, const Vpl& vpl) const {
        const Vec3 d = vpl.position - hit.position;
        const float inverse = 1.0f / sqrtf(length_squared(d));
        const SphereCone cone{d * inverse, smaller(radius * inverse, 1.0f)};
        const float cos_l = glm::dot(cone.axis, s.normal);
        const float cos_v = -glm::dot(cone.axis, vpl.normal);
        if (!(cos_l > 0.0f) || !(cos_v > 0.0f)) return {};
        if (cone.sine < least_sine)
            return B::eval(s.bsdf, s.normal, cone.axis, s.wo) *
                   (vpl.intensity * (cos_l * cos_v * (inverse * inverse)));
        const Rgb radiance = vpl.intensity * (1.0f / (pi * radius * radius));
        if constexpr (std::is_same_v<B, Lambert>)
            if (smaller(cos_l, cos_v) >= cone.sine)
                return B::eval(s.bsdf, s.normal, cone.axis, s.wo) * radiance *
                       cone.cosine_product(cos_l, cos_v, -glm::dot(s.normal, vpl.normal));
        return radiance * sampled(cone, s, vpl, Random(seed, Stream::vsl, pair_index(hit, vpl)));
    }

 private:
    /// Cones that single precision cannot tell from their axis.
    static constexpr float least_sine = 1e-4f;

    /// Sum of f (n.w) (-w.n_v) over the density of both techniques, for light from `wi`.
    [[nodiscard]] MIR_HD Rgb weighed(const SphereCone& cone, const Surface& s, const Vpl& vpl,
                                     Vec3 wi, float bsdf_pdf) const {
        const float cos_l = glm::dot(wi, s.normal);
        const float cos_v = -glm::dot(wi, vpl.normal);
        if (!(cos_l > 0.0f) || !(cos_v > 0.0f)) return {};
        const float density = static_cast<float>(samples) * (cone.pdf() + bsdf_pdf);
        return B::eval(s.bsdf, s.normal, wi, s.wo) * (cos_l * cos_v / density);
    }

    /// The integral, from strata that share one random offset.
    [[nodiscard]] MIR_HD Rgb sampled(const SphereCone& cone, const Surface& s, const Vpl& vpl,
                                     Random random) const {
        const Frame frame = Frame::around(cone.axis);
        const Vec2 offset = random.next_2d();
        const float lobe_offset = random.next();
        Rgb sum;
        for (std::uint32_t k = 0; k < samples; ++k) {
            const auto i = static_cast<float>(k);
            const Vec2 u(below_one((i + offset.x) / static_cast<float>(samples)),
                         fraction(i * 0.618033989f + offset.y));
            const Vec3 wi = frame.to_world(cone.direction(u));
            sum += weighed(cone, s, vpl, wi, B::pdf(s.bsdf, s.normal, wi, s.wo));
            const BsdfSample b =
                B::sample(s.bsdf, s.normal, s.wo, u, fraction(i * 0.754877666f + lobe_offset));
            if (b.pdf > 0.0f && cone.contains(b.wi)) sum += weighed(cone, s, vpl, b.wi, b.pdf);
        }
        return sum;
    }

    static MIR_HD float below_one(float x) { return smaller(x, 0x1.fffffep-1f); }
    /// x - floor(x) of a positive number.
    static MIR_HD float fraction(float x) {
        return x - static_cast<float>(static_cast<std::uint32_t>(x));
    }

    /// Names the pair among all others: a hash of both places (FNV-1a by words).
    static MIR_HD std::uint64_t pair_index(const Hit& hit, const Vpl& vpl) {
        std::uint64_t hash = 0xcbf29ce484222325ull;
        for (const Vec3 p : {hit.position, vpl.position})
            for (int c = 0; c < 3; ++c) {
                std::uint32_t word = 0;
                memcpy(&word, &p[c], sizeof word);
                hash = (hash ^ word) * 0x100000001b3ull;
                hash ^= hash >> 32;
            }
        return hash;
    }
};

}  // namespace mir
