// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/vpl.hpp"
#include "mir/shading/inverse_distance.hpp"

#include <limits>

namespace mir {

/// Geometry term of a luxel and a VPL, m^-2: cos cos / d^2 with the shading normal at the luxel
/// and the geometric one at the VPL; 0 when either points away (docs/method.md, 4.2). `inverse` is
/// 1 / d.
MIR_HD inline float geometry_term(Vec3 wi, float inverse, Vec3 luxel_normal, Vec3 vpl_normal) {
    const float cos_l = larger(glm::dot(wi, luxel_normal), 0.0f);
    const float cos_v = larger(-glm::dot(wi, vpl_normal), 0.0f);
    return cos_l * cos_v * (inverse * inverse);
}

/// J f min(G, bound): what an unoccluded VPL adds to a luxel's radiance. Model of Shading for any
/// Bsdf. The bound tames 1/d^2 next to a VPL at the price of removed energy, which
/// RemovedByBound measures.
template <Bsdf B>
struct VplShading {
    /// What it reads of a luxel.
    using Surface = mir::Surface<typename B::Params>;

    float bound = std::numeric_limits<float>::max();  ///< largest geometry term, m^-2

    /// False where f is zero: no ray is worth its while.
    [[nodiscard]] MIR_HD bool reflects(const Surface& s) const { return !B::is_black(s.bsdf); }

    /// Radiance towards the viewer, W m^-2 sr^-1, as if nothing lay between.
    // Inlined by force: a call would keep loops over luxels from being vectorised.
    [[gnu::always_inline]] MIR_HD Rgb operator()(const Hit& hit, const Surface& s,
                                                 const Vpl& vpl) const {
        return at_distance(hit, s, vpl, inverse_distance(hit, vpl));
    }
    /// The same, 1/d being known, m^-1.
    [[nodiscard, gnu::always_inline]] MIR_HD Rgb at_distance(const Hit& hit, const Surface& s,
                                                             const Vpl& vpl, float inverse) const {
        const Vec3 wi = (vpl.position - hit.position) * inverse;
        const float g = smaller(geometry_term(wi, inverse, s.normal, vpl.normal), bound);
        return B::eval(s.bsdf, s.normal, wi, s.wo) * (vpl.intensity * g);
    }
};

/// J f max(G - bound, 0): the part of a contribution that VplShading leaves out. Model of Shading;
/// VplShading + RemovedByBound = unbounded shading.
template <Bsdf B>
struct RemovedByBound {
    /// What it reads of a luxel.
    using Surface = mir::Surface<typename B::Params>;

    float bound = std::numeric_limits<float>::max();  ///< largest geometry term, m^-2

    /// Radiance towards the viewer, W m^-2 sr^-1; 0 where G is no larger than the bound.
    [[gnu::always_inline]] MIR_HD Rgb operator()(const Hit& hit, const Surface& s,
                                                 const Vpl& vpl) const {
        const float inverse = inverse_distance(hit, vpl);
        const Vec3 wi = (vpl.position - hit.position) * inverse;
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
