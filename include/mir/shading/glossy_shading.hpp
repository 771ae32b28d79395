// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shading/vpl_shading.hpp"

namespace mir {

/// How the surface of a VPL reflects the light that arrives there. A plain value.
template <Bsdf B>
struct VplLobe {
    bool is_set = false;  ///< false: the VPL shines as a Lambertian surface, with its own intensity
    Vec3 normal{0};       ///< unit shading normal
    Vec3 towards_light{0};      ///< unit
    Rgb power;                  ///< W, see VplArrival
    typename B::Params bsdf{};  ///< how the surface reflects

    /// Radiant intensity towards the unit vector `w` over the cosine there, W sr^-1.
    [[nodiscard]] MIR_HD Rgb intensity(Vec3 w) const {
        if (!(glm::dot(w, normal) > 0.0f)) return {};
        return power * B::eval(bsdf, normal, towards_light, w);
    }
};

/// P f_v f min(G, bound), or P f_v f max(G - bound, 0). What an unoccluded VPL that keeps the lobe
/// of its surface adds to a luxel's radiance, W m^-2 sr^-1, and what the bound removes of that.
/// VplShading and RemovedByBound where the VPL's surface is Lambertian.
template <Bsdf B>
struct GlossyShading {
    using Surface = mir::Surface<typename B::Params>;  ///< what is read of luxels

    float bound = std::numeric_limits<float>::max();  ///< largest geometry term, m^-2
    bool removed = false;                             ///< what lies above the bound, not below it

    /// False where no VPL adds anything.
    [[nodiscard]] MIR_HD bool reflects(const Surface& s) const { return !B::is_black(s.bsdf); }

    /// W m^-2 sr^-1; `lobe` is that of the VPL.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface& s, const Vpl& vpl,
                                        const VplLobe<B>& lobe) const {
        const Vec3 d = vpl.position - hit.position;
        const float inverse = 1.0f / sqrtf(length_squared(d));
        const Vec3 wi = d * inverse;
        const float g = geometry_term(wi, inverse, s.normal, vpl.normal);
        const float part = removed ? g - bound : smaller(g, bound);
        if (!(part > 0.0f)) return {};
        const Rgb j = lobe.is_set ? lobe.intensity(-wi) : vpl.intensity;
        return B::eval(s.bsdf, s.normal, wi, s.wo) * (j * part);
    }
};

}  // namespace mir
