// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/number_text.hpp"
#include "mir/scene/opacity.hpp"
#include "mir/scene/texture_table.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace mir {

/// The mask of a material.
[[nodiscard]] inline AlphaMask alpha_mask_of(const Material& m) {
    return {m.alpha, m.alpha_cutoff, m.textures.base_color};
}

/// What of a material says how much light goes straight through it.
[[nodiscard]] inline SeeThrough see_through_of(const Material& m) {
    MaterialTextures own;
    own.base_color = m.textures.base_color;
    own.metallic_roughness = m.textures.metallic_roughness;
    own.transmission = m.textures.transmission;
    return {m.factors(), m.alpha, m.is_blended, m.is_see_through(), own};
}

/// Masks and see-through materials of a scene, with the images that they read. Needs the scene no
/// more when it is made. Immutable, and neither copied nor moved, because views point into it;
/// const use from any thread.
class OpacityTable {
 public:
    /// @throws Error(invalid_input) when an alpha, a transmission or a coat lies outside 0..1 or a
    /// cutoff
    ///         is negative or not finite; where some material is not opaque, what TextureTable
    ///         throws.
    explicit OpacityTable(const Scene& scene) {
        for (const Material& m : scene.materials) check(m);
        const auto any = [&](auto is) {
            return std::any_of(scene.materials.begin(), scene.materials.end(), is);
        };
        // Colours of vertices may tint what is clear.
        const bool is_tinted = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                           [](const Mesh& m) { return !m.colors.empty(); });
        const auto is_nothing = [&](const Material& m) { return !is_tinted && m.is_nothing(); };
        const bool has_masks =
            any([&](const Material& m) { return m.is_masked() || is_nothing(m); });
        const bool has_see_through = any([](const Material& m) { return m.is_see_through(); });
        if (!has_masks && !has_see_through) return;
        const TextureTable given(scene);
        images_.assign(given.images().begin(), given.images().end());
        texels_.resize(images_.size());
        for (const Material& m : scene.materials) {
            if (has_masks)
                masks_.push_back(is_nothing(m) ? AlphaMask{0.0f, 1.0f, {}} : alpha_mask_of(m));
            if (has_see_through) see_through_.push_back(see_through_of(m));
            if (m.is_masked() || m.is_see_through()) keep(scene, m.textures.base_color);
            if (!m.is_see_through()) continue;
            keep(scene, m.textures.metallic_roughness);
            keep(scene, m.textures.transmission);
        }
    }
    OpacityTable(const OpacityTable&) = delete;
    OpacityTable& operator=(const OpacityTable&) = delete;
    ~OpacityTable() = default;

    /// By material; none when no material is masked.
    [[nodiscard]] std::span<const AlphaMask> masks() const { return masks_; }
    /// By material; none when no material is seen through.
    [[nodiscard]] std::span<const SeeThrough> see_through() const { return see_through_; }
    /// Of such materials alone; others must not be looked up.
    [[nodiscard]] TextureView<Space::host> textures() const {
        return {images_.data(), texel_values().data()};
    }
    /// What kernels on the host ask about the triangles of `geometry`, which has these materials.
    [[nodiscard]] OpacityView<Space::host> view(const GeometryView<Space::host>& geometry) const {
        if (masks_.empty() && see_through_.empty()) return {};
        return {geometry, masks_.empty() ? nullptr : masks_.data(),
                see_through_.empty() ? nullptr : see_through_.data(), textures()};
    }

 private:
    static void check(const Material& m) {
        const auto fail = [&](const std::string& what) {
            throw Error(ErrorCode::invalid_input,
                        "material " + detail::in_quotes(m.name) + ": " + what);
        };
        if (!(m.alpha >= 0.0f && m.alpha <= 1.0f))
            fail("its alpha is " + number_text(m.alpha) +
                 " (it is a share of the surface); use a number from 0 to 1");
        if (!(m.alpha_cutoff >= 0.0f) || !std::isfinite(m.alpha_cutoff))
            fail("its alpha cutoff is " + number_text(m.alpha_cutoff) +
                 " (no alpha can be compared with it); use a number from 0, which cuts nothing "
                 "away, to 1");
        if (!(m.transmission >= 0.0f && m.transmission <= 1.0f))
            fail("its transmission is " + number_text(m.transmission) +
                 " (it is a share of the light); use a number from 0 to 1");
        for (const float share : {m.clearcoat, m.clearcoat_roughness})
            if (!(share >= 0.0f && share <= 1.0f))
                fail("its clear coat has " + number_text(share) +
                     " as weight or roughness (they are shares); use numbers from 0 to 1");
        const Rgb& through = m.diffuse_transmission_color;
        for (const float share : {m.diffuse_transmission, through.r, through.g, through.b})
            if (!(share >= 0.0f && share <= 1.0f))
                fail("its diffuse transmission or the colour of that is " + number_text(share) +
                     " (they are shares of the light); use numbers from 0 to 1");
    }

    void keep(const Scene& scene, const Texture& texture) {
        if (!texture.is_set()) return;
        texels_[texture.image] = scene.images[texture.image].texels;
        images_[texture.image].texels = texels_[texture.image].data();
    }

    std::vector<AlphaMask> masks_;
    std::vector<SeeThrough> see_through_;
    std::vector<std::vector<std::uint32_t>> texels_;
    std::vector<TexelView> images_;
};

}  // namespace mir
