// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/texture_table.hpp"
#include "mir/shading/material_params.hpp"
#include "mir/shading/mean_factors.hpp"
#include "mir/shading/surface_table_view.hpp"

#include <algorithm>
#include <cmath>
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
        for (const Material& m : scene.materials) {
            bends_rays_ = bends_rays_ || bends_rays(scene, m);
            entries_.push_back({specular_end_params<B>(material_params(m, B{}), m.roughness),
                                m.emission, m.emits_from_both_sides, lobe_share(scene, m),
                                mean_albedo(scene, m), m.factors(), m.textures,
                                is_specular(scene, m), m.is_blended, m.alpha, absorption(m)});
        }
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
    /// Luminance of what leaves either side at a typical angle, 0..1: what Keller's rho
    /// averages.
    [[nodiscard]] float mean_albedo(std::uint32_t material) const {
        return entries_[material].mean_albedo;
    }
    /// True when some material mirrors rays or lets them through in another direction.
    [[nodiscard]] bool bends_rays() const { return bends_rays_; }
    /// True when a material reflects alike in all directions (Material::is_lambertian()).
    [[nodiscard]] bool is_lambertian(std::uint32_t material) const {
        return view().is_lambertian(material);
    }

 private:
    /// Whether chains go on from it, or end on its other side.
    static bool is_specular(const Scene& scene, const Material& m) {
        return SpecularBsdf<B> &&
               (m.is_blended || m.clearcoat > 0.0f || m.is_translucent() || bends_rays(scene, m));
    }
    /// Whether some of it goes on in one direction that is not that of before.
    static bool bends_rays(const Scene& scene, const Material& m) {
        bool mirrors = false;
        if constexpr (SpecularBsdf<B>) mirrors = B::has_interface;
        if (m.transmission > 0.0f && m.metallic < 1.0f) return true;
        const auto may_be_smooth = [&](float roughness, const Texture& texture) {
            return is_smooth(roughness) || is_smooth(roughness * least_green(scene, texture));
        };
        const MaterialTextures& t = m.textures;
        if (mirrors && m.clearcoat > 0.0f &&
            may_be_smooth(m.clearcoat_roughness, t.clearcoat_roughness))
            return true;
        const bool reflects = m.metallic > 0.0f || m.specular > 0.0f;
        return mirrors && reflects && may_be_smooth(m.roughness, t.metallic_roughness);
    }
    /// Smallest value that a texture multiplies a roughness by, 0..1.
    static float least_green(const Scene& scene, const Texture& texture) {
        if (!texture.is_set()) return 1.0f;
        std::uint32_t least = 255;
        for (const std::uint32_t texel : scene.images[texture.image].texels)
            least = std::min(least, texel >> 8 & 0xffu);
        return static_cast<float>(least) / 255.0f;
    }
    /// Source: KHR_materials_volume: attenuation_color is what is left after the distance.
    static Rgb absorption(const Material& m) {
        if (m.is_thin || !std::isfinite(m.attenuation_distance)) return {};
        const auto channel = [&](float left) {
            return -std::log(larger(left, 1e-6f)) / m.attenuation_distance;
        };
        const Rgb& left = m.attenuation_color;
        return {channel(left.r), channel(left.g), channel(left.b)};
    }
    static float mean_albedo(const Scene& scene, const Material& m) {
        const MaterialFactors mean = mean_factors(scene, m);
        float all = typical_albedo(material_params(mean, CookTorrance{}));
        if (m.is_translucent())
            all += typical_albedo(
                CookTorrance::without_lobe(material_params(mean.through(), CookTorrance{})));
        return smaller(all, 1.0f);
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

    bool bends_rays_ = false;
    TextureTable textures_;
    std::vector<SurfaceEntry<B>> entries_;
};

}  // namespace mir
