// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/space.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/vpl.hpp"

#include <concepts>

namespace mir {

/// Radiance that an unoccluded VPL adds to a luxel. `typename F::Surface` says which surface data
/// it reads.
///
/// Axioms (validation/shading.hpp): finite, not negative, zero below either horizon, linear in the
/// channels of the VPL's intensity (so black ones may be skipped), repeatable, traces no ray. It is
/// also asked of luxels that do not see the VPL, empty ones among them, as of VPLs that none sees:
/// it must not fail there, and its result is thrown away.
template <class F>
concept Shading = DeviceCopyable<F> &&
    requires(const F f, const Hit& h, const typename F::Surface& s, const Vpl& v) {
    { f(h, s, v) } -> std::same_as<Rgb>;
};

/// Shading that accepts a precomputed offset and inverse distance. Callers can so hide the latency
/// of the square root and the division. With w = v.position - h.position, metres, f.at_distance(h,
/// s, v, w, F::inverse_distance(w)) is f(h, s, v) in every bit. F itself must declare the member:
/// an inherited one is ignored, because a derived class may shade differently.
template <class F>
concept DistanceShading = Shading<F> &&
    std::same_as<decltype(&F::at_distance), Rgb (F::*)(const Hit&, const typename F::Surface&,
                                                       const Vpl&, Vec3, float) const> &&
    requires(Vec3 w) {
    { F::inverse_distance(w) } -> std::same_as<float>;
};

/// Shading that prepares a luxel once for all VPLs, in a type of its own. With p =
/// f.prepared(h, s), f(p, v) is f(h, s, v) in every bit. F declares it itself, as a
/// DistanceShading does.
template <class F>
concept PreparedShading = Shading<F> &&
    std::same_as<decltype(&F::prepared),
                 typename F::Prepared (F::*)(const Hit&, const typename F::Surface&) const> &&
    requires(const F f, const typename F::Prepared& p, const Vpl& v) {
    { f(p, v) } -> std::same_as<Rgb>;
};

/// Shading that is zero beyond a distance, so that whole blocks can be skipped.
template <class F>
concept ReachLimitedShading = Shading<F> && requires(const F f) {
    { f.reach_squared() } -> std::same_as<float>;
};

/// Shading that knows from the surface alone that it reflects nothing. No ray is traced then.
/// `reflects` may only be false where every contribution is zero. It is also asked of empty luxels,
/// whose surfaces mean nothing, and must not fail there.
template <class F>
concept SurfaceSelectiveShading = Shading<F> && requires(const F f, const typename F::Surface& s) {
    { f.reflects(s) } -> std::same_as<bool>;
};

}  // namespace mir
