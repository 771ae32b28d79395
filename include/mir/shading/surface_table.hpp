// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/texture_table.hpp"
#include "mir/shading/material_params.hpp"
#include "mir/shading/mean_factors.hpp"
#include "mir/shading/surface_table_view.hpp"

#include <span>
#include <vector>

namespace mir {

/// The materials of a scene in the parameters of one Bsdf. A scene with images must outlive it.
/// Immutable; const use from any thread.
template <Bsdf B>
class SurfaceTable {
 public:
    /// What a luxel knows of its surface.
    using Surface = mir::Surface<typename B::Params>;

    /// @throws Error(invalid_input) as TextureTable does.
    explicit SurfaceTable(const Scene& scene) : textures_(scene) {
        for (const Material& m : scene.materials)
            entries_.push_back({material_params(m, B{}), m.emission, m.emits_from_both_sides,
                                lobe_share(scene, m), mean_albedo(scene, m), m.factors(),
                                m.textures});
    }

    /// What kernels on the host read; valid until the table is moved or ends.
    [[nodiscard]] SurfaceTableView<Space::host, B> view() const {
        return {entries_.data(), textures_.view()};
    }
    /// Images that the materials refer to.
    [[nodiscard]] const TextureTable& textures() const { return textures_; }
    /// By material, in the order of Scene::materials.
    [[nodiscard]] std::span<const SurfaceEntry<B>> entries() const { return entries_; }

    /// Surface data of a point for light that leaves along the unit vector `wo`.
    [[nodiscard]] Surface surface(const SurfacePoint& p, Vec3 wo) const {
        return view().surface(p, wo);
    }
    /// The same of a luxel that is seen from the direction `wo`.
    [[nodiscard]] Surface luxel_surface(const SurfacePoint& p, Vec3 wo) const {
        return view().luxel_surface(p, wo);
    }

    /// How a material reflects without its textures and vertex colours.
    [[nodiscard]] const typename B::Params& params(std::uint32_t material) const {
        return view().params(material);
    }
    /// Luminance of the reflectance at a typical angle, 0..1: what Keller's rho averages.
    [[nodiscard]] float mean_albedo(std::uint32_t material) const {
        return entries_[material].mean_albedo;
    }
    /// True when a material reflects alike in all directions (Material::is_lambertian()).
    [[nodiscard]] bool is_lambertian(std::uint32_t material) const {
        return view().is_lambertian(material);
    }

 private:
    static float mean_albedo(const Scene& scene, const Material& m) {
        return smaller(typical_albedo(material_params(mean_factors(scene, m), CookTorrance{})),
                       1.0f);
    }
    static float lobe_share(const Scene& scene, const Material& m) {
        if (m.is_lambertian()) return 0.0f;
        CookTorrance::Params p = material_params(mean_factors(scene, m), CookTorrance{});
        const float all = typical_albedo(p);
        p.diffuse = {};
        constexpr float least = 1e-6f;
        return all > 0.0f ? larger(typical_albedo(p) / all, least) : 1.0f;
    }
    static float typical_albedo(const CookTorrance::Params& p) {
        const Vec3 n(0.0f, 0.0f, 1.0f);
        const Vec3 wo(0.6f, 0.0f, 0.8f);
        return luminance(CookTorrance::albedo(p, n, wo));
    }

    TextureTable textures_;
    std::vector<SurfaceEntry<B>> entries_;
};

}  // namespace mir
