// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rounding.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/vpl.hpp"
#include "mir/shading/inverse_distance.hpp"
#include "mir/shading/outgoing_bsdf.hpp"

#include <limits>

namespace mir {

/// Geometry term of a luxel and a VPL, m^-2: cos cos / d^2. It takes the shading normal at the
/// luxel and the geometric one at the VPL; it is 0 when either points away (docs/method.md, 4.2).
/// `inverse` is 1 / d, the cosines those of the direction from the luxel to the VPL and back.
MIR_HD inline float geometry_term(float cos_l, float cos_v, float inverse) {
    return larger(cos_l, 0.0f) * larger(cos_v, 0.0f) * (inverse * inverse);
}
/// The same by directions.
MIR_HD inline float geometry_term(Vec3 wi, float inverse, Vec3 luxel_normal, Vec3 vpl_normal) {
    return geometry_term(glm::dot(wi, luxel_normal), -glm::dot(wi, vpl_normal), inverse);
}

/// J f min(G, bound): what an unoccluded VPL adds to a luxel's radiance. Model of Shading for any
/// Bsdf. The bound tames 1/d^2 next to a VPL at the price of removed energy, which
/// RemovedByBound measures. Sums of products are rounded by `Rounding` (core/rounding.hpp), in `B`
/// too if it is a PreparedBsdf.
template <Bsdf B, class Rounding = FusedRounding>
struct VplShading {
    /// What it reads of a luxel.
    using Surface = mir::Surface<typename B::Params>;

    /// A luxel, and what `B` makes of it alone.
    struct Prepared {
        Vec3 position;                       ///< metres
        Vec3 normal;                         ///< unit shading normal
        OutgoingBsdf<B, Rounding> outgoing;  ///< towards the viewer
    };

    float bound = std::numeric_limits<float>::max();  ///< largest geometry term, m^-2

    /// False where f is zero: no ray is worth its while.
    [[nodiscard]] MIR_HD bool reflects(const Surface& s) const { return !B::is_black(s.bsdf); }

    /// Radiance towards the viewer, W m^-2 sr^-1, as if nothing lay between.
    // Inlined by force: a call would keep loops over luxels from being vectorised.
    [[gnu::always_inline]] MIR_HD Rgb operator()(const Hit& hit, const Surface& s,
                                                 const Vpl& vpl) const {
        return (*this)(prepared(hit, s), vpl);
    }
    /// 1/d, m^-1, of the offset from a luxel to a VPL, metres.
    [[nodiscard, gnu::always_inline]] MIR_HD static float inverse_distance(Vec3 offset) {
        return mir::inverse_distance<Rounding>(offset);
    }
    /// Radiance from the `offset` to the VPL, metres, and its inverse length. `inverse` is 1/d,
    /// m^-1.
    [[nodiscard, gnu::always_inline]] MIR_HD Rgb at_distance(const Hit& hit, const Surface& s,
                                                             const Vpl& vpl, Vec3 offset,
                                                             float inverse) const {
        return of(prepared(hit, s), vpl, offset, inverse);
    }
    /// What is the same for all VPLs.
    [[nodiscard, gnu::always_inline]] MIR_HD Prepared prepared(const Hit& hit,
                                                               const Surface& s) const {
        return {hit.position, s.normal, outgoing_bsdf<B, Rounding>(s.bsdf, s.normal, s.wo)};
    }
    /// Radiance of a luxel that was prepared.
    [[gnu::always_inline]] MIR_HD Rgb operator()(const Prepared& luxel, const Vpl& vpl) const {
        const Vec3 offset = vpl.position - luxel.position;
        return of(luxel, vpl, offset, mir::inverse_distance<Rounding>(offset));
    }

 private:
    [[nodiscard, gnu::always_inline]] MIR_HD Rgb of(const Prepared& luxel, const Vpl& vpl,
                                                    Vec3 offset, float inverse) const {
        const Vec3 wi = offset * inverse;
        const float cos_l = dot<Rounding>(wi, luxel.normal);
        const float cos_v = -dot<Rounding>(wi, vpl.normal);
        const float g = strict::at_most(geometry_term(cos_l, cos_v, inverse), bound);
        return luxel.outgoing(wi, cos_l) * (vpl.intensity * g);
    }
};

/// J f max(G - bound, 0): the part of a contribution that VplShading leaves out. Model of Shading;
/// VplShading + RemovedByBound = unbounded shading.
template <Bsdf B>
struct RemovedByBound {
    /// What it reads of a luxel.
    using Surface = mir::Surface<typename B::Params>;

    float bound = std::numeric_limits<float>::max();  ///< largest geometry term, m^-2

    /// Radiance towards the viewer, W m^-2 sr^-1. 0 where G is no larger than the bound.
    [[gnu::always_inline]] MIR_HD Rgb operator()(const Hit& hit, const Surface& s,
                                                 const Vpl& vpl) const {
        const Vec3 offset = vpl.position - hit.position;
        const float inverse = inverse_distance<SeparateRounding>(offset);
        const Vec3 wi = offset * inverse;
        const float excess = geometry_term(wi, inverse, s.normal, vpl.normal) - bound;
        if (!(excess > 0.0f)) return {};
        return B::eval(s.bsdf, s.normal, wi, s.wo) * vpl.intensity * excess;
    }

    /// False where f is zero: no ray is worth its while.
    [[nodiscard]] MIR_HD bool reflects(const Surface& s) const { return !B::is_black(s.bsdf); }

    /// No luxel farther than this from a VPL can lose anything: G <= 1/d^2.
    [[nodiscard]] MIR_HD float reach_squared() const { return 1.0f / bound; }
};

}  // namespace mir
