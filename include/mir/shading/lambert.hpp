// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/rgb.hpp"
#include "mir/core/warp.hpp"
#include "mir/data/bsdf_sample.hpp"

namespace mir {

/// Ideal diffuse reflection: f = reflectance / pi, sr^-1. Model of Bsdf.
struct Lambert {
    static constexpr bool has_interface = false;  ///< opaque surfaces mirror nothing

    /// Three words per surface point.
    struct Params {
        Rgb reflectance;  ///< hemispherical albedo, 0..1
    };

    /// f(wi, wo), sr^-1, where `wi` lies above `n`.
    [[gnu::always_inline]] MIR_HD static Rgb eval(const Params& p, Vec3 /*n*/, Vec3 /*wi*/,
                                                  Vec3 /*wo*/) {
        return p.reflectance * inv_pi;
    }

    /// Density of sample() at `wi`, per steradian.
    MIR_HD static float pdf(const Params& /*p*/, Vec3 n, Vec3 wi, Vec3 /*wo*/) {
        return cosine_hemisphere_pdf(glm::dot(n, wi));
    }

    /// True when nothing is reflected in any direction.
    MIR_HD static bool is_black(const Params& p) { return mir::is_black(p.reflectance); }

    /// Reflection `c` times as strong. The end of a specular chain that leaves `c` of the light
    /// has it.
    MIR_HD static Params scaled(const Params& p, Rgb c) { return {p.reflectance * c}; }
    /// The same parameters: there is no interface.
    MIR_HD static Params without_lobe(const Params& p) { return p; }

    /// Hemispherical reflectance.
    MIR_HD static Rgb albedo(const Params& p, Vec3 /*n*/, Vec3 /*wo*/) { return p.reflectance; }

    /// Cosine-distributed around `n`, from `u` in [0, 1)^2. The weight f cos / pdf is the
    /// reflectance.
    MIR_HD static BsdfSample sample(const Params& p, Vec3 n, Vec3 /*wo*/, Vec2 u, float /*lobe*/) {
        const Vec3 wi = Frame::around(n).to_world(square_to_cosine_hemisphere(u));
        return {wi, p.reflectance, pdf(p, n, wi, {})};
    }
};

}  // namespace mir
