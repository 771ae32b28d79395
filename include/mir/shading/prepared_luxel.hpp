// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"

namespace mir {

/// A luxel that many VPLs are to light, as `F` wants it. What every Shading reads.
template <Shading F>
struct PreparedLuxel {
    Hit hit;                      ///< where it is
    typename F::Surface surface;  ///< what is there

    /// Of the luxel with that hit and surface.
    [[nodiscard]] MIR_HD static PreparedLuxel of(const F& /*shade*/, const Hit& hit,
                                                 const typename F::Surface& surface) {
        return {hit, surface};
    }
    /// shade(hit, surface, vpl), W m^-2 sr^-1, in every bit; `shade` is that of of().
    [[nodiscard, gnu::always_inline]] MIR_HD Rgb lit_by(const Vpl& vpl, const F& shade) const {
        return shade(hit, surface, vpl);
    }
};

/// What a PreparedShading made of it.
template <PreparedShading F>
struct PreparedLuxel<F> {
    typename F::Prepared luxel;  ///< the shading's own

    /// Of the luxel with that hit and surface.
    [[nodiscard]] MIR_HD static PreparedLuxel of(const F& shade, const Hit& hit,
                                                 const typename F::Surface& surface) {
        return {shade.prepared(hit, surface)};
    }
    /// shade(hit, surface, vpl), W m^-2 sr^-1, in every bit; `shade` is that of of().
    [[nodiscard, gnu::always_inline]] MIR_HD Rgb lit_by(const Vpl& vpl, const F& shade) const {
        return shade(luxel, vpl);
    }
};

}  // namespace mir
