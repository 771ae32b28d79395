// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/warp.hpp"
#include "mir/paths/path_world.hpp"

namespace mir {

/// A light end together with its vertex.
struct PlacedLightEnd {
    /// Of ends outside the scene only the normal counts: the way that their light travels.
    PathVertex vertex;
    /// What else is known of it.
    LightEnd end;
};

namespace detail {

template <class Lights>
MIR_HD PlacedLightEnd area_end(const Lights& lights, std::uint32_t light, const EmitterSample& s,
                               bool back) {
    PlacedLightEnd placed;
    const Vec3 n = back ? -s.normal : s.normal;
    placed.vertex = {lift(s.position, n, s.offset), n, n, s.barycentrics, s.triangle, 0};
    const double density =
        static_cast<double>(lights.light_probability(light)) * static_cast<double>(s.pdf_area);
    placed.end = {LightEndKind::area, s.light_group, light,
                  s.radiance,         density,       s.both_sides ? 0.5 * density : density};
    return placed;
}

template <class Lights>
MIR_HD PlacedLightEnd delta_end(const Lights& lights, std::uint32_t light) {
    const double probability = static_cast<double>(lights.light_probability(light));
    const DeltaSource& source = lights.delta_source(light);
    PlacedLightEnd placed;
    placed.vertex.position = source.position;
    placed.vertex.normal = source.direction;
    placed.end = {source.kind,     source.light_group, light,
                  source.emission, probability,        probability};
    return placed;
}

/// `uv` picks the direction. Its density is that for light samples and for light paths: the place
/// where a light path enters the scene belongs to its first ray.
template <class Lights>
MIR_HD PlacedLightEnd environment_end(const Lights& lights, std::uint32_t light, Vec2 uv) {
    const EnvironmentSample s = lights.environment.sample(uv);
    const double density =
        static_cast<double>(lights.light_probability(light)) * static_cast<double>(s.pdf);
    PlacedLightEnd placed;
    placed.vertex.normal = -s.direction;
    placed.end = {LightEndKind::environment,
                  lights.environment.light_group,
                  light,
                  s.radiance,
                  density,
                  density};
    return placed;
}

/// A light end that is no point of a triangle.
template <class Lights>
MIR_HD PlacedLightEnd other_end(const Lights& lights, std::uint32_t light, Vec2 uv) {
    return lights.is_environment(light) ? environment_end(lights, light, uv)
                                        : delta_end(lights, light);
}

}  // namespace detail

/// Light end for the receiver at `from`, the light chosen by power: next-event estimation.
template <class World>
MIR_HD PlacedLightEnd sample_light_end(const World& world, float pick, Vec2 uv, Vec3 from) {
    const auto& lights = world.lights;
    const std::uint32_t light = lights.sample_light(pick);
    if (!lights.is_triangle(light)) return detail::other_end(lights, light, uv);
    const EmitterSample s = lights.point_on(world.geometry, light, uv);
    const bool back = s.both_sides && glm::dot(from - s.position, s.normal) < 0.0f;
    return detail::area_end(lights, light, s, back);
}

/// Light end for a light path, the light chosen by power. `side` picks the side of a lamp that
/// shines from both.
template <class World>
MIR_HD PlacedLightEnd sample_light_start(const World& world, float pick, Vec2 uv, float side) {
    const auto& lights = world.lights;
    const std::uint32_t light = lights.sample_light(pick);
    if (!lights.is_triangle(light)) return detail::other_end(lights, light, uv);
    const EmitterSample s = lights.point_on(world.geometry, light, uv);
    return detail::area_end(lights, light, s, s.both_sides && side >= 0.5f);
}

/// Writes the light end of a path that ran into the surface `at`; false when its side that was hit
/// does not emit.
template <class World>
MIR_HD bool light_end_at(const World& world, const PathVertex& at, LightEnd& end) {
    const auto& lights = world.lights;
    const std::uint32_t light = lights.light_of(at.triangle);
    if (light == lights.none) return false;
    EmitterSample s = lights.point_on(world.geometry, light, {0.0f, 0.0f});
    s.radiance = lights.radiance_at(world.geometry, at.triangle, at.barycentrics);
    const bool back = glm::dot(at.normal, s.normal) < 0.0f;
    if (back && !s.both_sides) return false;
    end = detail::area_end(lights, light, s, back).end;
    return true;
}

/// Light that leaves the end along the unit vector `w`, and what it becomes at a receiver with the
/// squared distance d2: L_e cos / d2, I / d2, E, or L_e of an environment. The receiver's own
/// cosine is not in it.
template <class World>
MIR_HD Rgb light_at_receiver(const World& world, const PathVertex& v, const LightEnd& end, Vec3 w,
                             float d2) {
    switch (end.kind) {
        case LightEndKind::area:
            return end.emission * (larger(glm::dot(w, v.normal), 0.0f) / d2);
        case LightEndKind::point:
            return end.emission * (1.0f / d2);
        case LightEndKind::spot:
            return end.emission * (spot_falloff(world.lights.delta_source(end.light), w) / d2);
        default:
            return end.emission;
    }
}

/// Density per m^2 of a surface with cosine `cos_receiver` with which a light path from this end
/// hits it along the unit vector `w` after the squared distance d2.
template <class World>
MIR_HD double light_ray_density(const World& world, const PathVertex& v, const LightEnd& end,
                                Vec3 w, float cos_receiver, float d2) {
    const auto& lights = world.lights;
    if (is_from_outside(end.kind))
        return static_cast<double>(cos_receiver) /
               (static_cast<double>(pi) * lights.radius * lights.radius);
    const double to_area = static_cast<double>(cos_receiver) / static_cast<double>(d2);
    if (end.kind == LightEndKind::area)
        return to_area * static_cast<double>(cosine_hemisphere_pdf(glm::dot(w, v.normal)));
    if (end.kind == LightEndKind::point) return to_area * static_cast<double>(sphere_pdf());
    const DeltaSource& spot = lights.delta_source(end.light);
    return glm::dot(w, spot.direction) > spot.cos_outer
               ? to_area * static_cast<double>(cone_pdf(spot.cos_outer))
               : 0.0;
}

}  // namespace mir
