// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/lights/lamp.hpp"
#include "mir/scene/lights/light_bounds.hpp"
#include "mir/scene/texture_table.hpp"
#include "mir/scene/world_geometry.hpp"

#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace mir {

namespace detail {

inline void check_emission(Rgb value, const std::string& what, const std::string& name) {
    if (is_finite(value) && value.r >= 0.0f && value.g >= 0.0f && value.b >= 0.0f) return;
    throw Error(ErrorCode::invalid_input, what + " " + in_quotes(name) +
                                              " emits a negative or infinite amount of light "
                                              "(it cannot be sampled); repair its emission");
}

/// `power` as a weight of sampling.
inline float checked_power(double power, const std::string& who) {
    const auto narrow = static_cast<float>(power);
    if (std::isfinite(narrow)) return narrow;
    throw Error(ErrorCode::invalid_input,
                who +
                    " more power than 32-bit numbers hold (light is sampled by it); lower the "
                    "emission, or the size of what shines or is lit");
}

/// Covered share of a material without its place: a texture counts by its mean.
inline float mean_cover(const Scene& scene, const Material& m) {
    if (!m.is_blended) return 1.0f;
    const Texture& texture = m.textures.base_color;
    return texture.is_set() ? m.alpha * mean_alpha_of(scene.images[texture.image]) : m.alpha;
}

/// Radiance of a material without its place: textures count by their means.
inline Rgb mean_emission(const Scene& scene, const Material& m) {
    if (!m.emits()) return m.emission;
    const Texture& texture = m.textures.emission;
    const Rgb light = m.emission * mean_cover(scene, m);
    if (!texture.is_set()) return light;
    return light * mean_of(scene.images[texture.image], TexelEncoding::srgb);
}

/// The images of a scene where lamps use any. A device holds them once more for the lights.
inline TextureTable lamp_textures(const Scene& scene) {
    for (const Material& m : scene.materials)
        if (m.emits() && (m.textures.emission.is_set() || m.is_masked() || m.is_blended))
            return TextureTable(scene);
    return {};
}

}  // namespace detail

/// The emissive triangles of a scene, ready to be sampled. Immutable; const use from any thread.
/// The scene's images and the WorldGeometry must outlive it.
class LampTable {
 public:
    /// @throws Error(invalid_input) when an emission is negative or not finite, or the power of a
    ///         triangle is no float.
    LampTable(const Scene& scene, const WorldGeometry& geometry)
        : textures_(detail::lamp_textures(scene)) {
        for (const Material& m : scene.materials) {
            detail::check_emission(m.emission, "material", m.name);
            entries_.push_back({m.emission, m.light_group, m.textures.emission, alpha_mask_of(m),
                                m.is_blended, m.is_see_through()});
        }
        find_triangles(scene, geometry);
        by_power_ = DiscreteDistribution(powers_);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i)
            lamp_triangles_.push_back({geometry.front_normal(triangles_[i]),
                                       1.0f / geometry.area(triangles_[i]),
                                       by_power_.empty() ? 0.0f : by_power_.probability(i),
                                       shines_from_both_sides(scene, geometry, triangles_[i])});
    }

    /// What kernels on the host read; valid until the table is changed or ends.
    [[nodiscard]] LampView<Space::host> view() const {
        return {triangles_.data(),
                lamp_triangles_.data(),
                static_cast<std::uint32_t>(triangles_.size()),
                entries_.data(),
                by_power_.view(),
                textures_.view()};
    }

    /// Indices into WorldGeometry::triangles(), ascending.
    [[nodiscard]] std::span<const std::uint32_t> triangles() const { return triangles_; }
    /// Of the same triangles: luminance of their power, W. Textures count by their mean.
    [[nodiscard]] std::span<const float> powers() const { return powers_; }
    /// Of the same triangles.
    [[nodiscard]] std::span<const LampTriangle> lamp_triangles() const { return lamp_triangles_; }
    /// What a LightTree knows of the triangle at `index` of triangles().
    [[nodiscard]] LightBounds light_bounds(const WorldGeometry& geometry, std::size_t index) const;
    /// By material.
    [[nodiscard]] std::span<const LampEntry> entries() const { return entries_; }
    /// Picks triangles by powers().
    [[nodiscard]] const DiscreteDistribution& by_power() const { return by_power_; }
    /// The scene's images if a lamp has a texture or a mask, else none.
    [[nodiscard]] const TextureTable& textures() const { return textures_; }

 private:
    void find_triangles(const Scene& scene, const WorldGeometry& geometry);
    static bool shines_from_both_sides(const Scene& scene, const WorldGeometry& geometry,
                                       std::uint32_t triangle) {
        return scene.materials[geometry.material_of(triangle)].emits_from_both_sides &&
               !geometry.is_split(triangle);
    }

    TextureTable textures_;
    std::vector<std::uint32_t> triangles_;
    std::vector<float> powers_;
    std::vector<LampTriangle> lamp_triangles_;
    std::vector<LampEntry> entries_;
    DiscreteDistribution by_power_;
};

inline void LampTable::find_triangles(const Scene& scene, const WorldGeometry& geometry) {
    std::vector<Rgb> radiance;
    for (const Material& m : scene.materials) radiance.push_back(detail::mean_emission(scene, m));
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
        const Material& m = scene.materials[geometry.material_of(t)];
        if (!m.emits()) continue;
        const float sides = shines_from_both_sides(scene, geometry, t) ? 2.0f : 1.0f;
        triangles_.push_back(t);
        powers_.push_back(detail::checked_power(
            luminance(radiance[geometry.material_of(t)]) * pi * geometry.area(t) * sides,
            "material " + detail::in_quotes(m.name) + " emits"));
    }
}

inline LightBounds LampTable::light_bounds(const WorldGeometry& geometry, std::size_t index) const {
    const LampTriangle& lamp = lamp_triangles_[index];
    const GeometryView<Space::host> view = geometry.view();
    LightBounds bounds;
    float offset = 0.0f;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Vec3 corner = view.corner(triangles_[index], k);
        bounds.box.add(corner);
        offset = larger(offset, view.offset_at(corner, 1.0f / std::sqrt(lamp.inverse_area)));
    }
    // Its points are lifted; a little more pays for what rounding moves.
    bounds.box.low -= Vec3(2.0f * offset);
    bounds.box.high += Vec3(2.0f * offset);
    bounds.cone = {lamp.normal, 0.0f, 0.5f * pi, lamp.both_sides};
    bounds.power = powers_[index];
    return bounds;
}

}  // namespace mir
