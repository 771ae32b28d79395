// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/core/ray.hpp"
#include "mir/core/space.hpp"
#include "mir/data/luxel.hpp"

namespace mir {

/// One material in the parameters of a Bsdf.
template <Bsdf B>
struct SurfaceEntry {
    typename B::Params params;
    Rgb emission;              ///< radiance, W m^-2 sr^-1
    bool both_sides = false;   ///< emits from the back too
    bool lambertian = true;    ///< see Material::is_lambertian()
    float mean_albedo = 0.0f;  ///< luminance of the reflectance at a typical angle, 0..1
};

/// What kernels read of a SurfaceTable. A view; thread-safe.
template <Space S, Bsdf B>
struct SurfaceTableView {
    static constexpr Space space = S;
    using Surface = mir::Surface<typename B::Params>;

    const SurfaceEntry<B>* entries = nullptr;  ///< by material

    /// Surface data of a point for light that leaves along the unit vector `wo`.
    [[nodiscard]] MIR_HD Surface surface(const SurfacePoint& p, Vec3 wo) const {
        const SurfaceEntry<B>& e = entries[p.material];
        return {p.shading_normal, wo, p.front || e.both_sides ? e.emission : Rgb{}, e.params};
    }

    [[nodiscard]] MIR_HD const typename B::Params& params(std::uint32_t material) const {
        return entries[material].params;
    }
    [[nodiscard]] MIR_HD bool is_lambertian(std::uint32_t material) const {
        return entries[material].lambertian;
    }
};

}  // namespace mir
