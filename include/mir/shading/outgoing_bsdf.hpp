// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"

namespace mir {

/// What any other Bsdf has for PreparedBsdf's Outgoing: its arguments.
template <Bsdf B>
struct UnpreparedBsdf {
    typename B::Params params;  ///< of the surface point
    Vec3 n;                     ///< unit shading normal
    Vec3 wo;                    ///< unit direction towards the viewer

    /// f(wi, wo), sr^-1.
    [[nodiscard, gnu::always_inline]] MIR_HD Rgb operator()(Vec3 wi, float /*cos_i*/) const {
        return B::eval(params, n, wi, wo);
    }
};

/// `B` at a surface point towards the viewer, with rounding by `Rounding`. Its sums of products are
/// rounded so if `B` is a PreparedBsdf and left to it if not.
template <Bsdf B, class Rounding>
[[nodiscard, gnu::always_inline]] MIR_HD inline auto outgoing_bsdf(const typename B::Params& p,
                                                                   Vec3 n, Vec3 wo) {
    if constexpr (PreparedBsdf<B>)
        return B::template outgoing<Rounding>(p, n, wo);
    else
        return UnpreparedBsdf<B>{p, n, wo};
}

/// Its type.
template <Bsdf B, class Rounding>
using OutgoingBsdf = decltype(outgoing_bsdf<B, Rounding>(typename B::Params{}, Vec3{0}, Vec3{0}));

}  // namespace mir
