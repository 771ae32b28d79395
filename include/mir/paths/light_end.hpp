// SPDX-License-Identifier: MIT
#pragma once

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

/// A point of light `light` as the end of a path.
template <class Lights>
MIR_HD PlacedLightEnd end_at(const Lights& lights, std::uint32_t light, LightOrigin origin,
                             const LightPoint& p) {
    const double probability = static_cast<double>(lights.light_probability(light));
    PlacedLightEnd placed;
    placed.vertex = {p.position, p.normal, p.normal, p.barycentrics, p.triangle, 0};
    placed.end = {origin,
                  p.light_group,
                  light,
                  p.emission,
                  probability * static_cast<double>(p.pdf),
                  probability * static_cast<double>(p.pdf_start())};
    return placed;
}

}  // namespace detail

/// Light end for the receiver at `from`, the light chosen by power: next-event estimation.
template <class World>
MIR_HD PlacedLightEnd sample_light_end(const World& world, float pick, Vec2 uv, Vec3 from) {
    const auto& lights = world.lights;
    const std::uint32_t light = lights.sample_light(pick);
    return lights.visit(world.geometry, light, [&](const auto& source) {
        return detail::end_at(lights, light, source.origin, source.sample(uv, from));
    });
}

/// Light end for a light path, the light chosen by power. `side` picks the side of a lamp that
/// shines from both.
template <class World>
MIR_HD PlacedLightEnd sample_light_start(const World& world, float pick, Vec2 uv, float side) {
    const auto& lights = world.lights;
    const std::uint32_t light = lights.sample_light(pick);
    return lights.visit(world.geometry, light, [&](const auto& source) {
        return detail::end_at(lights, light, source.origin, source.start(uv, side));
    });
}

/// Writes the light end of a path that ran into the surface `at`. False when its side that was hit
/// does not emit.
template <class World>
MIR_HD bool light_end_at(const World& world, const PathVertex& at, LightEnd& end) {
    const auto& lamps = world.lights.lamps;
    const std::uint32_t light = lamps.index_of(at.triangle);
    if (light == lamps.none) return false;
    const LampSource<World::space> lamp{lamps, world.geometry, light};
    LightPoint point;
    if (!lamp.met(at.barycentrics, at.normal, point)) return false;
    end = detail::end_at(world.lights, light, lamp.origin, point).end;
    return true;
}

/// First ray of a light path whose end is given.
template <class World>
MIR_HD Ray ray_from_light(const World& world, const PathVertex& v, const LightEnd& end, Vec2 uv) {
    return world.lights.visit(world.geometry, end.light, [&](const auto& source) {
        return source.ray(v.position, v.normal, uv);
    });
}

/// Light that leaves the end along `w`, as a receiver gets it. At the squared distance d2 that is
/// L_e cos / d2, I / d2, E, or L_e of an environment; `w` is a unit vector. The receiver's own
/// cosine is not in it.
template <class World>
MIR_HD Rgb light_at_receiver(const World& world, const PathVertex& v, const LightEnd& end, Vec3 w,
                             float d2) {
    return world.lights.visit(world.geometry, end.light, [&](const auto& source) {
        return end.emission * (source.share(v.normal, w) / d2);
    });
}

/// Density per m^2 with which a light path from this end hits a surface. The surface has cosine
/// `cos_receiver` along the unit vector `w` after the squared distance d2.
template <class World>
MIR_HD double light_ray_density(const World& world, const PathVertex& v, const LightEnd& end,
                                Vec3 w, float cos_receiver, float d2) {
    return world.lights.visit(world.geometry, end.light, [&](const auto& source) {
        return source.ray_density(v.normal, w, cos_receiver, d2);
    });
}

}  // namespace mir
