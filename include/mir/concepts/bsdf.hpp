// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/core/rounding.hpp"
#include "mir/data/bsdf_sample.hpp"
#include "mir/data/soa.hpp"

#include <concepts>

namespace mir {

/// A reflection model: `Params` per surface point and pure functions of directions. `n` is the unit
/// shading normal, `wi` and `wo` unit directions away from the surface.
///
/// Axioms (validation/bsdf.hpp):
///  1. eval(wi, wo) = eval(wo, wi), finite and not negative;
///  2. the directional albedo is at most 1 (1.0025 where a model says so);
///  3. albedo() lies in [0, 1]; is_black() only where eval() is zero for all directions;
///  4. sample() follows pdf(), and its weight is eval cos / pdf;
///  5. where `wo` lies below `n`, a model that reflects alike in all directions still does, and any
///     other reflects nothing: eval(), pdf() and the weight of sample() are zero.
///
/// eval() means something where `wi` lies above `n`. It is called for others, too, and
/// for what is no number, a luxel that lies on a lamp: it must not fail there, and its result is
/// thrown away.
///
/// Micro-buffers with BufferWarp::importance look for a static ReflectionLobe lobe(p, n, wo)
/// (shading/reflection_lobe.hpp); a model without it, or with another return type, gets no second
/// buffer.
template <class B>
concept Bsdf = WordCopyable<typename B::Params> &&
    requires(const typename B::Params& p, Vec3 n, Vec3 wi, Vec3 wo, Vec2 u, float v) {
    { B::eval(p, n, wi, wo) } -> std::same_as<Rgb>;
    { B::pdf(p, n, wi, wo) } -> std::same_as<float>;
    { B::sample(p, n, wo, u, v) } -> std::same_as<BsdfSample>;
    { B::albedo(p, n, wo) } -> std::same_as<Rgb>;
    { B::is_black(p) } -> std::same_as<bool>;
};

/// A Bsdf that may stand at the end of a specular chain. scaled(p, c) reflects `c` times as much as
/// `p`; without_lobe(p) leaves out what mirrors and clear glass do, because chains carry that;
/// without has_interface opaque surfaces mirror nothing. Of another Bsdf all surfaces are opaque
/// and rough.
template <class B>
concept SpecularEndBsdf = Bsdf<B> && requires(const typename B::Params& p, Rgb c) {
    { B::scaled(p, c) } -> std::same_as<typename B::Params>;
    { B::without_lobe(p) } -> std::same_as<typename B::Params>;
    { B::has_interface } -> std::convertible_to<bool>;
};

/// A Bsdf that prepares a point and `wo` once for all directions of light. Its sums of products are
/// rounded as the template argument says (core/rounding.hpp). With o =
/// B::outgoing<SeparateRounding>(p, n, wo), o(wi, n.wi) is eval(p, n, wi, wo) in every bit where
/// `wo` lies above `n`; with FusedRounding it is the same function, rounded differently. The type
/// of `o` names B as its Model: a member inherited from a base is ignored, because a derived class
/// may reflect differently.
template <class B>
concept PreparedBsdf = Bsdf<B> &&
    requires(const typename B::Params& p, Vec3 n, Vec3 wi, Vec3 wo, float cos_i) {
    { B::template outgoing<SeparateRounding>(p, n, wo)(wi, cos_i) } -> std::same_as<Rgb>;
    { B::template outgoing<FusedRounding>(p, n, wo)(wi, cos_i) } -> std::same_as<Rgb>;
    requires std::same_as<typename decltype(B::template outgoing<FusedRounding>(p, n, wo))::Model,
                          B>;
};

}  // namespace mir
