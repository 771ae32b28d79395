// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/discrete_distribution.hpp"
#include "mir/core/warp.hpp"
#include "mir/scene/alpha_mask.hpp"
#include "mir/scene/environment_view.hpp"
#include "mir/scene/geometry_view.hpp"
#include "mir/scene/light.hpp"

namespace mir {

/// A point on an emissive triangle.
struct EmitterSample {
    Vec3 position{0};               ///< on the surface, not lifted; off edges as SurfacePoint's
    float offset = 0.0f;            ///< by which segments that leave it are lifted, metres
    Vec3 normal{0};                 ///< unit, of the triangle's front
    Rgb radiance;                   ///< W m^-2 sr^-1; black where the triangle's mask cuts it away
    float pdf_area = 0.0f;          ///< of this point among all emissive triangles, m^-2
    bool both_sides = false;        ///< shines from the back too
    std::uint16_t light_group = 0;  ///< group that the lamp's light is counted in
    std::uint32_t triangle = 0;     ///< index into WorldGeometry::triangles()
    Vec2 barycentrics{0};           ///< weights of the triangle's second and third vertex
};

/// What a light path may end on.
enum class LightEndKind : std::uint8_t {
    area,         ///< a point of an emissive triangle
    point,        ///< a point light
    spot,         ///< a spot light
    directional,  ///< light from outside the scene: it has a direction, but no place
    environment   ///< the same, from any direction
};

/// True for light that comes from outside the scene.
MIR_HD constexpr bool is_from_outside(LightEndKind kind) {
    return kind == LightEndKind::directional || kind == LightEndKind::environment;
}

/// A light without extent: a PointLight, SpotLight or DirectionalLight but for its name.
struct DeltaSource {
    LightEndKind kind = LightEndKind::point;  ///< point, spot or directional
    std::uint16_t light_group = 0;            ///< group that its light is counted in
    Rgb emission;                             ///< intensity in W sr^-1, or irradiance in W m^-2
    Vec3 position{0};                         ///< metres; of directional lights none
    Vec3 direction{0, 0, 1};                  ///< unit, along which it shines; of point lights any
    float cos_inner = 1.0f;                   ///< of spot lights
    float cos_outer = 1.0f;                   ///< of spot lights
};

/// What the triangles of a material emit.
struct LampEntry {
    Rgb radiance;                   ///< W m^-2 sr^-1
    std::uint16_t light_group = 0;  ///< group that its light is counted in
    Texture texture{};              ///< multiplies the radiance
    AlphaMask mask{};               ///< where it cuts away, nothing shines
};

/// What samples of an emissive triangle share.
struct LampTriangle {
    Vec3 normal{0};             ///< unit, of its front
    float inverse_area = 0.0f;  ///< m^-2
    float probability = 0.0f;   ///< with which it is picked among the emissive triangles
    bool both_sides = false;    ///< the back shines as the front does
};

/// What kernels read of a LightTable. Lights are counted as there: first emissive triangles, then
/// point, spot and directional lights, then the environment if it shines. A view; thread-safe.
template <Space S>
struct LightTableView {
    static constexpr Space space = S;  ///< where the arrays lie

    /// Answer of light_of() for triangles that emit nothing.
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    const std::uint32_t* triangles = nullptr;      ///< emissive ones, ascending
    const LampTriangle* lamp_triangles = nullptr;  ///< the same, in that order
    std::uint32_t triangle_count = 0;              ///< emissive triangles
    const DeltaSource* delta_sources = nullptr;    ///< point, spot, then directional lights
    std::uint32_t delta_count = 0;                 ///< lights without extent
    const LampEntry* lamps = nullptr;              ///< by material
    DiscreteDistributionView<S> by_power;          ///< of all lights
    DiscreteDistributionView<S> emitters;          ///< of emissive triangles alone, by power
    Vec3 centre{0};                                ///< of the scene's bounding sphere, metres
    float radius = 0.0f;                           ///< of the scene's bounding sphere, metres
    TextureView<S> textures{};                     ///< of the lamps
    EnvironmentView<S> environment{};              ///< around the scene

    /// True when nothing emits power: sample_light() has no answer.
    [[nodiscard]] MIR_HD bool empty() const { return by_power.empty(); }
    /// Luminance of the power emitted by everything, W.
    [[nodiscard]] MIR_HD double power() const { return by_power.total; }

    /// Any light by power, for u in [0, 1). Must not be empty().
    [[nodiscard]] MIR_HD std::uint32_t sample_light(float u) const { return by_power.sample(u); }
    /// Probability with which sample_light() picks `light`.
    [[nodiscard]] MIR_HD float light_probability(std::uint32_t light) const {
        return by_power.probability(light);
    }

    /// True for the index of an emissive triangle, as sample_light() counts.
    [[nodiscard]] MIR_HD bool is_triangle(std::uint32_t light) const {
        return light < triangle_count;
    }
    /// True for the index that the environment has, or would have if it shone.
    [[nodiscard]] MIR_HD bool is_environment(std::uint32_t light) const {
        return light == triangle_count + delta_count;
    }
    /// A light that is neither triangle nor environment.
    [[nodiscard]] MIR_HD const DeltaSource& delta_source(std::uint32_t light) const {
        return delta_sources[light - triangle_count];
    }

    /// True when emissive triangles exist, so that sample_emitter() may be called.
    [[nodiscard]] MIR_HD bool has_emitters() const { return !emitters.empty(); }

    /// Point on an emissive triangle: triangle by power with `u`, point uniform with `uv`.
    [[nodiscard]] MIR_HD EmitterSample sample_emitter(const GeometryView<S>& geometry, float u,
                                                      Vec2 uv) const {
        const std::uint32_t index = emitters.sample(u);
        EmitterSample s = point_on(geometry, index, uv);
        s.pdf_area *= lamp_triangles[index].probability;
        return s;
    }

    /// Index, as sample_light() counts, of an emissive triangle of the WorldGeometry, or `none`.
    [[nodiscard]] MIR_HD std::uint32_t light_of(std::uint32_t triangle) const {
        const std::uint32_t found =
            first_that(triangles, triangle_count, [=](std::uint32_t t) { return t >= triangle; });
        return found < triangle_count && triangles[found] == triangle ? found : none;
    }

    /// Point on the emissive triangle that is light `light`; pdf_area is that of the triangle
    /// alone.
    [[nodiscard]] MIR_HD EmitterSample point_on(const GeometryView<S>& geometry,
                                                std::uint32_t light, Vec2 uv) const {
        const std::uint32_t t = triangles[light];
        const LampEntry& lamp = lamps[geometry.materials[t]];
        EmitterSample s;
        s.barycentrics = square_to_triangle(uv);
        s.normal = lamp_triangles[light].normal;
        s.position = geometry.position(t, s.barycentrics);
        s.offset =
            geometry.offset_at(s.position, 1.0f / std::sqrt(lamp_triangles[light].inverse_area));
        s.position = geometry.place(t, s.barycentrics, s.offset);
        s.radiance = radiance_at(geometry, t, s.barycentrics);
        s.pdf_area = lamp_triangles[light].inverse_area;
        s.both_sides = lamp_triangles[light].both_sides;
        s.light_group = lamp.light_group;
        s.triangle = t;
        return s;
    }

    /// What a triangle emits at barycentrics of its second and third corner, W m^-2 sr^-1.
    [[nodiscard]] MIR_HD Rgb radiance_at(const GeometryView<S>& geometry, std::uint32_t triangle,
                                         Vec2 barycentrics) const {
        const LampEntry& lamp = lamps[geometry.materials[triangle]];
        if (!lamp.texture.is_set() && !lamp.mask.is_set()) return lamp.radiance;
        const Vec2 uv = geometry.attributes(triangle, barycentrics).texture_coordinates;
        if (lamp.mask.is_set() && !lamp.mask.is_solid(textures, uv)) return {};
        if (!lamp.texture.is_set()) return lamp.radiance;
        return lamp.radiance * textures.color(lamp.texture, uv, TexelEncoding::srgb);
    }
};

}  // namespace mir
