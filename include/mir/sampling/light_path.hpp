// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/data/vpl_record.hpp"
#include "mir/sampling/emission.hpp"
#include "mir/shading/surface_table.hpp"

namespace mir {

/// Light that arrives at a surface along a light path, seen from there.
template <Bsdf B>
struct Arrival {
    SurfacePoint point;     ///< its geometric normal lies on the side that the light comes from
    Vec3 towards_light{0};  ///< unit
    Rgb power;              ///< W, per path

    /// Jacobian of arriving power with a shading normal: (wi.ns) / (wi.ng). Source: Veach 1997,
    /// section 5.3, the adjoint BSDF.
    [[nodiscard]] MIR_HD float shading_normal_factor() const {
        return larger(glm::dot(towards_light, point.shading_normal), 0.0f) /
               larger(glm::dot(towards_light, point.geometric_normal), 1e-6f);
    }
};

/// The VPL of an arrival. `weight` is f cos / pdf of a sampled direction, whose mean is the
/// directional albedo: the VPL sends out exactly the reflected power, spread as a Lambertian
/// surface would. For Lambertian surfaces that is the truth; others lose the shape of their lobe.
template <Bsdf B>
MIR_HD Vpl reflective_vpl(const Arrival<B>& at, Rgb weight) {
    const Vec3 n = at.point.geometric_normal;
    return {lift(at.point), n, at.power * weight * (at.shading_normal_factor() * inv_pi)};
}

/// A path's start on the lamp as a VPL: J = L_e / pdf.
MIR_HD inline Vpl emitter_vpl(const Emission& e) {
    return {e.ray.origin, e.emitter.normal, e.emitter.emission * (1.0f / e.pdf_point)};
}

/// Light that leaves an arrival along `sample`, drawn around the normal `n`. Its power is black
/// when the sampled direction and the geometric side disagree.
template <Bsdf B>
MIR_HD Emission scatter(const Arrival<B>& at, const BsdfSample& sample, Vec3 n) {
    Emission out;
    const float cos_geometric = glm::dot(sample.wi, at.point.geometric_normal);
    const float cos_sampled = glm::dot(sample.wi, n);
    if (cos_geometric <= 0.0f || cos_sampled <= 0.0f) return out;
    out.ray = {lift(at.point), sample.wi};
    out.power =
        at.power * sample.weight * (at.shading_normal_factor() * (cos_geometric / cos_sampled));
    return out;
}

}  // namespace mir
