// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/paths/path.hpp"
#include "mir/scene/camera.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/check_bound.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/next_surface.hpp"
#include "mir/shading/surface_table.hpp"

#include <cmath>
#include <limits>

namespace mir {

/// What full paths run through, in memory of space `S`. A value of views that may be passed to a
/// kernel. The scene data must outlive it. On the host `R` may be any RayCaster, elsewhere it is a
/// PointFinder. Const use from any thread.
template <Bsdf B, class R, Visibility V, Space S = Space::host>
struct PathWorld {
    static_assert(AccessibleFrom<V, S>,
                  "mir: the visibility of a PathWorld lies in another memory than its scene");

    /// Model by which all surfaces reflect.
    using Bsdf = B;
    static constexpr Space space = S;  ///< memory that the views read

    GeometryView<S> geometry;                         ///< triangles
    LightTableView<S> lights;                         ///< what shines
    LuxelTracer<R, S, B> luxels;                      ///< what rays meet, and how that reflects
    V visibility;                                     ///< whether vertices see each other
    CameraOptics camera;                              ///< what paths start from
    float aspect = 1.0f;                              ///< width / height of the film
    float bound = std::numeric_limits<float>::max();  ///< of the geometry term x1, x2; m^-2
    /// Unit of areas behind x2, m^2. A power of four by the size of the scene. A product over 64
    /// vertices, each with its 1 / m^2, stays a number in scenes of any size.
    double area_unit = 1.0;

    /// Views that lie in space `S`. `geometry_bound`, m^-2, limits the geometry term between x1 and
    /// x2.
    /// @throws Error(invalid_argument) as check_bound(), and for an aspect ratio that is none.
    PathWorld(const GeometryView<S>& geometry_view, const LightTableView<S>& light_table,
              const SurfaceTableView<S, B>& surface_table, R ray_caster, V sight,
              const CameraOptics& optics, float film_aspect = 1.0f,
              float geometry_bound = std::numeric_limits<float>::max())
        : geometry(geometry_view),
          lights(light_table),
          luxels{ray_caster, surface_table},
          visibility(sight),
          camera(optics),
          aspect(film_aspect),
          bound(geometry_bound),
          area_unit(unit_for(geometry_view.ray_offset)) {
        check_bound(geometry_bound);
        expects(film_aspect > 0.0f && film_aspect <= std::numeric_limits<float>::max(),
                "the aspect ratio of a film is not a positive number; give width / height");
    }

    /// Views of what the host has.
    PathWorld(const WorldGeometry& world_geometry, const LightTable& light_table,
              const SurfaceTable<B>& surface_table, R ray_caster, V sight, const Camera& seen_from,
              float film_aspect = 1.0f,
              float geometry_bound = std::numeric_limits<float>::max()) requires(S == Space::host)
        : PathWorld(world_geometry.view(), light_table.view(), surface_table.view(), ray_caster,
                    sight, seen_from.optics(), film_aspect, geometry_bound) {}

    /// Writes the first surface along a ray as a path vertex. False when there is none. Blended
    /// surfaces and sheets of glass are passed as often as they let light through; bodies of glass
    /// and what sheets reflect are not part of paths behind x1.
    [[nodiscard]] MIR_HD bool hit(const Ray& ray, PathVertex& vertex) const {
        float passed = 1.0f;
        return hit(ray, vertex, passed);
    }
    /// The same, and with which chance the ray passed what it passed.
    [[nodiscard]] MIR_HD_CALL bool hit(const Ray& ray, PathVertex& vertex, float& passed) const {
        SurfacePoint p;
        passed = 1.0f;
        if (!find_point(luxels.caster, ray, p)) return false;
        bool is_through = false;
        if (luxels.surfaces.is_specular(p.material)) {
            RayNumbers numbers(ray);
            if (!pass_straight(ray, p, passed, numbers)) return false;
            const float chance = luxels.surfaces.through_chance(p.material, attributes_of(p));
            is_through = chance > 0.0f && numbers.next() < chance;
        }
        vertex = vertex_at(p, luxels.surfaces.shading_normal(p));
        vertex.is_through = is_through;
        return true;
    }
    /// The same of a ray that light runs along: what it meets is the vertex's other side where
    /// that lets it through diffusely.
    [[nodiscard]] MIR_HD_CALL bool hit_from_light(const Ray& ray, PathVertex& vertex) const {
        if (!hit(ray, vertex)) return false;
        if (vertex.is_through) vertex = other_side(vertex);
        return true;
    }
    /// Vertex x_i, i >= 1, as x_(i+1) sees it.
    [[nodiscard]] MIR_HD PathVertex lit_side(const Path& path, std::uint32_t i) const {
        return path.is_lit_behind(i) ? other_side(path.x(i)) : path.x(i);
    }
    /// One over the chance of what hit() has drawn at a vertex behind x1: that light is reflected
    /// or that it goes through. The chances are no part of densities, because all techniques draw
    /// by the same ones.
    [[nodiscard]] MIR_HD float event_weight(const PathVertex& v) const {
        if (!luxels.surfaces.is_specular(v.material)) return 1.0f;
        const float chance = luxels.surfaces.through_chance(
            v.material, geometry.attributes(v.triangle, v.barycentrics));
        if (!(chance > 0.0f)) return 1.0f;
        return 1.0f / (v.is_through ? chance : 1.0f - chance);
    }
    /// Chance with which a ray along the unit vector `w` that meets a vertex by hit() ends there:
    /// others pass it.
    [[nodiscard]] MIR_HD float stop_chance(const PathVertex& v, Vec3 w) const {
        const std::uint32_t material = geometry.materials[v.triangle];
        if (!luxels.surfaces.is_specular(material)) return 1.0f;
        const VertexAttributes at = geometry.attributes(v.triangle, v.barycentrics);
        const MaterialFactors factors = luxels.surfaces.factors(material, at);
        if (is_glass(factors)) return 0.0f;
        return 1.0f - passing(factors, material, at, fabsf(glm::dot(w, v.normal)));
    }
    /// The same of a camera ray: the vertex x1 of a path, which is a luxel, and the path's `eye`
    /// and `chain`.
    [[nodiscard]] MIR_HD_CALL bool hit_luxel(const Ray& ray, Path& path, PathVertex& vertex) const {
        const SeenLuxel seen = luxels(ray);
        if (seen.is_background) return false;
        vertex = vertex_at(seen.point, luxels.normal(seen));
        vertex.on_coat = seen.on_coat;
        vertex.is_through = seen.is_through;
        path.eye = seen.ray.origin;
        path.chain = seen.reflection;
        return true;
    }
    /// How the surface reflects at a vertex, textures and vertex colours included.
    [[nodiscard]] MIR_HD_CALL typename B::Params params(const PathVertex& v) const {
        if (v.on_coat || v.is_through) {
            const VertexAttributes at = geometry.attributes(v.triangle, v.barycentrics);
            return v.on_coat ? luxels.surfaces.coat(v.material, at)
                             : luxels.surfaces.through(v.material, at);
        }
        if (luxels.surfaces.is_specular(v.material))
            return luxels.surfaces.params_of_side(
                luxels.surfaces.params(v.material, geometry.attributes(v.triangle, v.barycentrics)),
                v.material, glm::dot(v.normal, geometry.front_normal(v.triangle)) > 0.0f);
        if (geometry.texture_coordinates == nullptr && geometry.colors == nullptr)
            return luxels.surfaces.params(v.material);
        return luxels.surfaces.params(v.material, geometry.attributes(v.triangle, v.barycentrics));
    }

 private:
    /// What ends paths behind x1 where it does not let them pass.
    [[nodiscard]] MIR_HD static bool is_glass(const MaterialFactors& m) {
        return m.transmission > 0.0f && m.metallic < 1.0f;
    }
    /// Chance with which a ray passes a point of a specular material.
    [[nodiscard]] MIR_HD float passing(const MaterialFactors& m, std::uint32_t material,
                                       const VertexAttributes& at, float cosine) const {
        return luminance(straight_transmittance(m, luxels.surfaces.coverage(material, at), cosine));
    }
    /// Goes straight on through what is seen through. False when the ray leaves the scene, or ends
    /// on glass.
    [[nodiscard]] MIR_HD bool pass_straight(Ray ray, SurfacePoint& p, float& passed,
                                            RayNumbers& numbers) const {
        for (std::uint32_t events = 0; luxels.surfaces.is_specular(p.material); ++events) {
            const VertexAttributes at = attributes_of(p);
            const MaterialFactors factors = luxels.surfaces.factors(p.material, at);
            const float chance =
                passing(factors, p.material, at, -glm::dot(ray.direction, p.geometric_normal));
            if (!(numbers.next() < chance)) return !is_glass(factors);
            passed *= chance;
            if (events == SpecularTracer<R, S, B>::longest) return false;
            if (!find_next(luxels.caster, -p.geometric_normal, ray, p)) return false;
        }
        return true;
    }
    /// A vertex turned over to the other side of its surface.
    [[nodiscard]] MIR_HD PathVertex other_side(PathVertex v) const {
        v.normal = -v.normal;
        v.shading_normal = -v.shading_normal;
        const float offset = geometry.offset_at(v.position);
        v.position = lift(geometry.place(v.triangle, v.barycentrics, offset), v.normal, offset);
        return v;
    }
    [[nodiscard]] MIR_HD static PathVertex vertex_at(const SurfacePoint& p, Vec3 shading_normal) {
        return {lift(p),        p.geometric_normal, shading_normal,
                p.barycentrics, p.triangle,         p.material};
    }
    /// The square of 2^-4 of the scene's size; `ray_offset` is about 2^-16 of that size. A double
    /// holds products over 64 edges of 2^-8 to 2^8 times its root, and over 33 of 2^-16 to 2^16.
    [[nodiscard]] static double unit_for(float ray_offset) {
        return ray_offset > 0.0f ? std::scalbn(1.0, 2 * (std::ilogb(ray_offset) + 12)) : 1.0;
    }
};
template <Bsdf B, class R, Visibility V>
PathWorld(const WorldGeometry&, const LightTable&, const SurfaceTable<B>&, R, V, const Camera&,
          float, float) -> PathWorld<B, R, V>;

}  // namespace mir
