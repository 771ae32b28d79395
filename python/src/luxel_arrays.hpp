// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/data/luxel.hpp"
#include "mir/shading/material_params.hpp"
#include "strided_floats.hpp"

namespace mirpy {

/// A place of a surface where segments leave it; metres, `normal` unit.
MIR_HD inline mir::Vec3 lifted(mir::Vec3 position, mir::Vec3 normal, float ray_offset) {
    return mir::lift(position, normal, mir::larger(ray_offset, mir::least_offset(position)));
}

/// The arrays of a G-buffer as kernels read them, host and device. A view.
struct LuxelArrays {
    using Surface = mir::Surface<mir::CookTorrance::Params>;

    StridedFloats position;        ///< (h, w, 3), metres, on the surface
    StridedFloats normal;          ///< (h, w, 3), unit, geometric; zero: background
    StridedFloats shading_normal;  ///< (h, w, 3), unit; none: `normal`
    StridedFloats view;            ///< (h, w, 3), unit, towards the viewer
    StridedFloats eye;             ///< (3,): place of the viewer, instead of `view`
    StridedFloats albedo;          ///< (h, w, 3): base colour, 0..1
    StridedFloats roughness;       ///< (h, w), 0..1; none: 1
    StridedFloats metallic;        ///< (h, w), 0..1; none: 0
    StridedFloats specular;        ///< (h, w), 0..1; none: 0, Lambertian
    float ray_offset = 0.0f;       ///< metres

    /// Of the pixel in row y.
    [[nodiscard]] MIR_HD mir::Hit hit(std::size_t y, std::size_t x) const {
        const mir::Vec3 n = normal.pixel(y, x);
        return {lifted(position.pixel(y, x), n, ray_offset), n};
    }
    /// Of the pixel in row y.
    [[nodiscard]] MIR_HD Surface surface(std::size_t y, std::size_t x) const {
        const mir::Vec3 color = albedo.pixel(y, x);
        mir::MaterialFactors factors;
        factors.base_color = {color.x, color.y, color.z};
        factors.roughness = roughness.exists() ? roughness.at(y, x) : 1.0f;
        factors.metallic = metallic.exists() ? metallic.at(y, x) : 0.0f;
        factors.specular = specular.exists() ? specular.at(y, x) : 0.0f;
        const mir::Vec3 n = (shading_normal.exists() ? shading_normal : normal).pixel(y, x);
        return {n, towards_viewer(y, x), {}, material_params(factors, mir::CookTorrance{})};
    }

 private:
    [[nodiscard]] MIR_HD mir::Vec3 towards_viewer(std::size_t y, std::size_t x) const {
        if (view.exists()) return view.pixel(y, x);
        return glm::normalize(mir::Vec3(eye.at(0), eye.at(1), eye.at(2)) - position.pixel(y, x));
    }
};

}  // namespace mirpy
