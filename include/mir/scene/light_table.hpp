// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/environment_table.hpp"
#include "mir/scene/light_table_view.hpp"
#include "mir/scene/texture_table.hpp"
#include "mir/scene/world_geometry.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mir {

/// All lights of a scene, ready to be sampled. Immutable; const use from any thread. The Scene and
/// the WorldGeometry must outlive it.
class LightTable {
 public:
    /// @throws Error(invalid_input) when an emission is negative or not finite, when the power of a
    ///         light or of all together is no float, and what EnvironmentTable throws.
    LightTable(const Scene& scene, const WorldGeometry& geometry);

    /// True when nothing emits power: sample_light() has no answer.
    [[nodiscard]] bool empty() const { return by_power_.empty(); }
    /// Those of the scene.
    [[nodiscard]] std::span<const PointLight> point_lights() const { return scene_->point_lights; }
    /// Those of the scene.
    [[nodiscard]] std::span<const SpotLight> spot_lights() const { return scene_->spot_lights; }
    /// Those of the scene.
    [[nodiscard]] std::span<const DirectionalLight> directional_lights() const {
        return scene_->directional_lights;
    }
    /// Indices into WorldGeometry::triangles(), ascending: element i is light i.
    [[nodiscard]] std::span<const std::uint32_t> emissive_triangles() const { return triangles_; }

    /// Luminance of the power emitted by everything, W. Directional lights and the environment
    /// count what passes the bounding sphere of the scene, textured lamps the mean of their image
    /// wherever it is seen, masked ones what they would emit if they were whole.
    [[nodiscard]] double power() const { return by_power_.total(); }

    /// True when emissive triangles exist, so that sample_emitter() may be called.
    [[nodiscard]] bool has_emitters() const { return !emitters_.empty(); }

    /// Point on an emissive triangle: triangle by power with `u`, point uniform with `uv`.
    [[nodiscard]] EmitterSample sample_emitter(float u, Vec2 uv) const {
        return view().sample_emitter(geometry_->view(), u, uv);
    }

    /// Density per m^2 with which sample_emitter() picks a point of `triangle`; 0 for others.
    [[nodiscard]] float emitter_pdf(std::uint32_t triangle) const;

    /// Any light by power, as an index: first emissive triangles, then point, spot and directional
    /// lights, then the environment. Must not be empty().
    [[nodiscard]] std::uint32_t sample_light(float u) const { return view().sample_light(u); }
    /// Probability with which sample_light() picks `light`, an index as it counts; sums to 1.
    [[nodiscard]] float light_probability(std::uint32_t light) const {
        return view().light_probability(light);
    }

    /// Index, as sample_light() counts, of an emissive triangle of the WorldGeometry.
    [[nodiscard]] std::optional<std::uint32_t> light_of(std::uint32_t triangle) const {
        const std::uint32_t light = view().light_of(triangle);
        if (light == LightTableView<Space::host>::none) return std::nullopt;
        return light;
    }

    /// Point on the emissive triangle at `index` of emissive_triangles(); pdf_area is that of the
    /// triangle alone.
    [[nodiscard]] EmitterSample point_on(std::uint32_t index, Vec2 uv) const {
        return view().point_on(geometry_->view(), index, uv);
    }

    /// Light from all around; empty() where the scene has none or a black one.
    [[nodiscard]] const EnvironmentTable& environment() const { return environment_; }

    /// Bounding sphere that light from outside is sent through.
    [[nodiscard]] Vec3 centre() const { return geometry_->bounds().centre(); }
    /// Half the diagonal of the bounding box, metres; 0 for a scene without vertices.
    [[nodiscard]] float radius() const { return 0.5f * geometry_->bounds().diagonal(); }

    /// What kernels on the host read; valid until the table is changed or ends.
    [[nodiscard]] LightTableView<Space::host> view() const {
        return {triangles_.data(),
                lamp_triangles_.data(),
                static_cast<std::uint32_t>(triangles_.size()),
                delta_sources_.data(),
                static_cast<std::uint32_t>(delta_sources_.size()),
                lamps_.data(),
                by_power_.view(),
                emitters_.view(),
                centre(),
                radius(),
                textures_.view(),
                environment_.view()};
    }
    /// The arrays of view().
    [[nodiscard]] std::span<const LampTriangle> lamp_triangles() const { return lamp_triangles_; }
    /// Those of the scene without extent.
    [[nodiscard]] std::span<const DeltaSource> delta_sources() const { return delta_sources_; }
    /// By material.
    [[nodiscard]] std::span<const LampEntry> lamps() const { return lamps_; }
    /// Weights of the lights as sample_light() counts: luminance of their power, W.
    [[nodiscard]] const DiscreteDistribution& by_power() const { return by_power_; }
    /// The weights of the emissive triangles alone.
    [[nodiscard]] const DiscreteDistribution& emitters() const { return emitters_; }
    /// Where the emissive triangles are.
    [[nodiscard]] const WorldGeometry& geometry() const { return *geometry_; }
    /// The images of the scene if a lamp has a texture or a mask, else none.
    [[nodiscard]] const TextureTable& textures() const { return textures_; }

 private:
    void add_triangles(std::vector<float>& power);
    void add_lamp_triangles();
    [[nodiscard]] bool shines_from_both_sides(std::uint32_t triangle) const;
    void add_delta_lights(std::vector<float>& power);
    void add_environment(std::vector<float>& power) const;

    const Scene* scene_;
    const WorldGeometry* geometry_;
    TextureTable textures_;
    EnvironmentTable environment_;
    std::vector<std::uint32_t> triangles_;
    std::vector<LampTriangle> lamp_triangles_;
    std::vector<DeltaSource> delta_sources_;
    std::vector<LampEntry> lamps_;
    DiscreteDistribution emitters_;
    DiscreteDistribution by_power_;
};

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

/// Radiance of a material as far as it does not depend on the place: a texture counts by its mean.
inline Rgb mean_emission(const Scene& scene, const Material& m) {
    const Texture& texture = m.textures.emission;
    if (!m.emits() || !texture.is_set()) return m.emission;
    return m.emission * mean_of(scene.images[texture.image], TexelEncoding::srgb);
}

/// The images of a scene where lamps use any: a device holds them once more for the lights.
inline TextureTable lamp_textures(const Scene& scene) {
    for (const Material& m : scene.materials)
        if (m.emits() && (m.textures.emission.is_set() || m.is_masked()))
            return TextureTable(scene);
    return {};
}

/// int over the sphere of the falloff of a spot light, sr: the smooth ring integrates to a third.
inline float spot_solid_angle(const SpotLight& s) {
    return 2.0f * pi * ((1.0f - s.cos_inner) + (s.cos_inner - s.cos_outer) / 3.0f);
}

}  // namespace detail

inline LightTable::LightTable(const Scene& scene, const WorldGeometry& geometry)
    : scene_(&scene), geometry_(&geometry), textures_(detail::lamp_textures(scene)) {
    if (scene.environment) environment_ = EnvironmentTable(*scene.environment);
    for (const Material& m : scene.materials) {
        detail::check_emission(m.emission, "material", m.name);
        lamps_.push_back({m.emission, m.light_group, m.textures.emission, alpha_mask_of(m)});
    }
    for (const PointLight& l : scene.point_lights)
        detail::check_emission(l.intensity, "point light", l.name);
    for (const SpotLight& l : scene.spot_lights)
        detail::check_emission(l.intensity, "spot light", l.name);
    for (const DirectionalLight& l : scene.directional_lights)
        detail::check_emission(l.irradiance, "directional light", l.name);
    std::vector<float> power;
    add_triangles(power);
    emitters_ = DiscreteDistribution(power);
    add_lamp_triangles();
    add_delta_lights(power);
    add_environment(power);
    by_power_ = DiscreteDistribution(power);
    static_cast<void>(detail::checked_power(by_power_.total(), "all lights together emit"));
}

inline void LightTable::add_triangles(std::vector<float>& power) {
    std::vector<Rgb> radiance;
    for (const Material& m : scene_->materials)
        radiance.push_back(detail::mean_emission(*scene_, m));
    for (std::uint32_t t = 0; t < geometry_->triangles().size(); ++t) {
        const Material& m = scene_->materials[geometry_->material_of(t)];
        if (!m.emits()) continue;
        const float sides = shines_from_both_sides(t) ? 2.0f : 1.0f;
        triangles_.push_back(t);
        power.push_back(detail::checked_power(
            luminance(radiance[geometry_->material_of(t)]) * pi * geometry_->area(t) * sides,
            "material " + detail::in_quotes(m.name) + " emits"));
    }
}

inline void LightTable::add_lamp_triangles() {
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        lamp_triangles_.push_back({geometry_->front_normal(triangles_[i]),
                                   1.0f / geometry_->area(triangles_[i]),
                                   emitters_.empty() ? 0.0f : emitters_.probability(i),
                                   shines_from_both_sides(triangles_[i])});
}

inline bool LightTable::shines_from_both_sides(std::uint32_t triangle) const {
    return scene_->materials[geometry_->material_of(triangle)].emits_from_both_sides &&
           !geometry_->is_split(triangle);
}

inline void LightTable::add_delta_lights(std::vector<float>& power) {
    const auto add = [&](const DeltaSource& source, float its_power, const std::string& who) {
        delta_sources_.push_back(source);
        power.push_back(detail::checked_power(its_power, who + " emits"));
    };
    for (const PointLight& l : scene_->point_lights)
        add({LightEndKind::point, l.light_group, l.intensity, l.position},
            luminance(l.intensity) * 4.0f * pi, "point light " + detail::in_quotes(l.name));
    for (const SpotLight& l : scene_->spot_lights)
        add({LightEndKind::spot, l.light_group, l.intensity, l.position, l.direction, l.cos_inner,
             l.cos_outer},
            luminance(l.intensity) * detail::spot_solid_angle(l),
            "spot light " + detail::in_quotes(l.name));
    for (const DirectionalLight& l : scene_->directional_lights)
        add({LightEndKind::directional, l.light_group, l.irradiance, {}, l.direction},
            luminance(l.irradiance) * pi * radius() * radius(),
            "directional light " + detail::in_quotes(l.name));
}

inline void LightTable::add_environment(std::vector<float>& power) const {
    if (environment_.empty()) return;
    const double disc = static_cast<double>(pi) * radius() * radius();
    power.push_back(detail::checked_power(
        environment_.view().total() * disc,
        "environment " + detail::in_quotes(scene_->environment->name) + " emits"));
}

inline float LightTable::emitter_pdf(std::uint32_t triangle) const {
    const auto index = light_of(triangle);
    return index ? emitters_.probability(*index) / geometry_->area(triangle) : 0.0f;
}

}  // namespace mir
