// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/light_source.hpp"
#include "mir/core/discrete_distribution.hpp"
#include "mir/core/frame.hpp"
#include "mir/core/warp.hpp"
#include "mir/scene/alpha_mask.hpp"
#include "mir/scene/geometry_view.hpp"
#include "mir/scene/textured_factors.hpp"

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

    /// Whether `from` lies where the back shines.
    [[nodiscard]] MIR_HD bool shows_back(Vec3 from) const {
        return both_sides && glm::dot(from - position, normal) < 0.0f;
    }
    /// The same point of one side.
    [[nodiscard]] MIR_HD LightPoint on_side(bool back) const {
        LightPoint p;
        p.normal = back ? -normal : normal;
        p.position = lift(position, p.normal, offset);
        p.emission = radiance;
        p.pdf = pdf_area;
        p.sides = both_sides ? 2 : 1;
        p.light_group = light_group;
        p.triangle = triangle;
        p.barycentrics = barycentrics;
        return p;
    }
};

/// What the triangles of a material emit.
struct LampEntry {
    Rgb radiance;                   ///< W m^-2 sr^-1
    std::uint16_t light_group = 0;  ///< group that its light is counted in
    Texture texture{};              ///< multiplies the radiance
    AlphaMask mask{};               ///< where it cuts away, nothing shines
    bool is_blended = false;        ///< the alpha of `mask` is the share that shines
    bool is_see_through = false;    ///< light behind it may be seen
};

/// What samples of an emissive triangle share.
struct LampTriangle {
    Vec3 normal{0};             ///< unit, of its front
    float inverse_area = 0.0f;  ///< m^-2
    float probability = 0.0f;   ///< with which it is picked among the emissive triangles
    bool both_sides = false;    ///< the back shines as the front does
};

/// The emissive triangles of a scene as kernels read them: LampTable. A view; thread-safe.
template <Space S>
struct LampView {
    static constexpr Space space = S;  ///< where the arrays lie

    /// Answer of index_of() for triangles that emit nothing.
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    const std::uint32_t* triangles = nullptr;      ///< emissive ones, ascending
    const LampTriangle* lamp_triangles = nullptr;  ///< the same, in that order
    std::uint32_t count = 0;                       ///< emissive triangles
    const LampEntry* entries = nullptr;            ///< by material
    DiscreteDistributionView<S> by_power;          ///< of the triangles
    TextureView<S> textures;                       ///< that entries refer to

    /// Point on an emissive triangle: triangle by power with `u`, point uniform with `uv`. There
    /// must be one that shines.
    [[nodiscard]] MIR_HD EmitterSample sample(const GeometryView<S>& geometry, float u,
                                              Vec2 uv) const {
        const std::uint32_t index = by_power.sample(u);
        EmitterSample s = point_on(geometry, index, uv);
        s.pdf_area *= lamp_triangles[index].probability;
        return s;
    }

    /// Density per m^2 with which sample() picks a point of a triangle of the WorldGeometry; 0 for
    /// those that emit nothing.
    [[nodiscard]] MIR_HD float pdf(const GeometryView<S>& geometry, std::uint32_t triangle) const {
        const std::uint32_t index = index_of(triangle);
        return index == none ? 0.0f : by_power.probability(index) / geometry.area(triangle);
    }

    /// Place among `triangles` of a triangle of the WorldGeometry, or `none`.
    [[nodiscard]] MIR_HD std::uint32_t index_of(std::uint32_t triangle) const {
        const std::uint32_t found =
            first_that(triangles, count, [=](std::uint32_t t) { return t >= triangle; });
        return found < count && triangles[found] == triangle ? found : none;
    }

    /// Point on the emissive triangle at `index` of `triangles`. pdf_area is that of the triangle
    /// alone.
    [[nodiscard]] MIR_HD EmitterSample point_on(const GeometryView<S>& geometry,
                                                std::uint32_t index, Vec2 uv) const {
        const std::uint32_t t = triangles[index];
        EmitterSample s;
        s.barycentrics = square_to_triangle(uv);
        s.normal = lamp_triangles[index].normal;
        s.position = geometry.position(t, s.barycentrics);
        s.offset =
            geometry.offset_at(s.position, 1.0f / std::sqrt(lamp_triangles[index].inverse_area));
        s.position = geometry.place(t, s.barycentrics, s.offset);
        s.radiance = radiance_at(geometry, t, s.barycentrics);
        s.pdf_area = lamp_triangles[index].inverse_area;
        s.both_sides = lamp_triangles[index].both_sides;
        s.light_group = entries[geometry.materials[t]].light_group;
        s.triangle = t;
        return s;
    }

    /// What a triangle emits at barycentrics of its second and third corner, W m^-2 sr^-1.
    [[nodiscard]] MIR_HD Rgb radiance_at(const GeometryView<S>& geometry, std::uint32_t triangle,
                                         Vec2 barycentrics) const {
        const LampEntry& lamp = entries[geometry.materials[triangle]];
        if (!lamp.texture.is_set() && !lamp.mask.is_set() && !lamp.is_blended) return lamp.radiance;
        const VertexAttributes at = geometry.attributes(triangle, barycentrics);
        const Vec2 uv = at.texture_coordinates;
        if (lamp.mask.is_set() && !lamp.mask.is_solid(textures, uv)) return {};
        Rgb light = lamp.radiance;
        if (lamp.is_blended)
            light = light * covered_share(lamp.mask.alpha, lamp.mask.texture, textures, at);
        if (!lamp.texture.is_set()) return light;
        return light * textures.color(lamp.texture, uv, TexelEncoding::srgb);
    }
    /// True where light from behind the triangle at `index` of `triangles` may come through.
    [[nodiscard]] MIR_HD bool is_see_through(const GeometryView<S>& geometry,
                                             std::uint32_t index) const {
        return entries[geometry.materials[triangles[index]]].is_see_through;
    }
};

/// An emissive triangle as one light among others. Model of LightSource.
template <Space S>
struct LampSource {
    /// How rays find it, see LightSource.
    static constexpr LightOrigin origin = LightOrigin::surface;
    /// Whether a point or a direction is drawn, see LightSource.
    static constexpr bool has_extent = true;

    const LampView<S>& lamps;         ///< outlives this
    const GeometryView<S>& geometry;  ///< outlives this
    std::uint32_t index = 0;          ///< of LampView::triangles

    /// A point of it for a receiver, see LightSource.
    [[nodiscard]] MIR_HD LightPoint sample(Vec2 u, Vec3 from) const {
        const EmitterSample s = lamps.point_on(geometry, index, u);
        return s.on_side(s.shows_back(from));
    }
    /// A point of it where a light path begins, see LightSource.
    [[nodiscard]] MIR_HD LightPoint start(Vec2 u, float side) const {
        const EmitterSample s = lamps.point_on(geometry, index, u);
        return s.on_side(s.both_sides && side >= 0.5f);
    }
    /// A ray that leaves it, see LightSource.
    [[nodiscard]] MIR_HD static Ray ray(Vec3 from, Vec3 normal, Vec2 u) {
        return {from, Frame::around(normal).to_world(square_to_cosine_hemisphere(u))};
    }
    /// Density of ray() at a surface, m^-2, see LightSource.
    [[nodiscard]] MIR_HD static double ray_density(Vec3 normal, Vec3 w, float cosine, float d2) {
        return per_receiver_area(cosine_hemisphere_pdf(glm::dot(w, normal)), cosine, d2);
    }
    /// Factor of the emission along a direction, see LightSource.
    [[nodiscard]] MIR_HD static float share(Vec3 normal, Vec3 w) {
        return larger(glm::dot(w, normal), 0.0f);
    }
    /// Power of a light path, W, see LightSource.
    [[nodiscard]] MIR_HD static Rgb flux(const LightPoint& p, Vec3 /*w*/, float probability) {
        return p.emission * (pi / (probability * p.pdf_start()));
    }

    /// Writes the point that a path ran into at these barycentrics. It lies on the side with this
    /// normal; false when that side does not shine.
    [[nodiscard]] MIR_HD bool met(Vec2 barycentrics, Vec3 normal, LightPoint& point) const {
        EmitterSample s = lamps.point_on(geometry, index, {0.0f, 0.0f});
        const bool back = glm::dot(normal, s.normal) < 0.0f;
        if (back && !s.both_sides) return false;
        s.radiance = lamps.radiance_at(geometry, s.triangle, barycentrics);
        point = s.on_side(back);
        return true;
    }
};

}  // namespace mir
