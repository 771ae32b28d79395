// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/core/ray.hpp"
#include "mir/data/luxel.hpp"
#include "mir/scene/scene.hpp"
#include "mir/shading/material_params.hpp"

#include <vector>

namespace mir {

/// The materials of a scene in the parameters of one Bsdf. Immutable; const use from any thread.
template <Bsdf B>
class SurfaceTable {
 public:
    using Surface = mir::Surface<typename B::Params>;

    explicit SurfaceTable(const Scene& scene) {
        for (const Material& m : scene.materials)
            entries_.push_back({material_params(m, B{}), m.emission, m.emits_from_both_sides,
                                m.is_lambertian(), mean_albedo(m)});
    }

    /// Surface data of a point for light that leaves along the unit vector `wo`.
    [[nodiscard]] Surface surface(const SurfacePoint& p, Vec3 wo) const {
        const Entry& e = entries_[p.material];
        return {p.shading_normal, wo, p.front || e.both_sides ? e.emission : Rgb{}, e.params};
    }

    [[nodiscard]] const typename B::Params& params(std::uint32_t material) const {
        return entries_[material].params;
    }
    /// Luminance of the reflectance at a typical angle, 0..1: what Keller's rho averages.
    [[nodiscard]] float mean_albedo(std::uint32_t material) const {
        return entries_[material].mean_albedo;
    }
    [[nodiscard]] bool is_lambertian(std::uint32_t material) const {
        return entries_[material].lambertian;
    }

 private:
    struct Entry {
        typename B::Params params;
        Rgb emission;
        bool both_sides = false;
        bool lambertian = true;
        float mean_albedo = 0.0f;
    };

    static float mean_albedo(const Material& m) {
        const CookTorrance::Params p = material_params(m, CookTorrance{});
        const Vec3 n(0.0f, 0.0f, 1.0f);
        const Vec3 wo(0.6f, 0.0f, 0.8f);
        return smaller(luminance(CookTorrance::albedo(p, n, wo)), 1.0f);
    }
    std::vector<Entry> entries_;
};

}  // namespace mir
