// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/sampling/path_numbers.hpp"
#include "mir/scene/light_table.hpp"

#include <optional>

namespace mir {

/// The start of a light path: a ray and the power it stands for.
struct Emission {
    Ray ray;                        ///< leaves the light; its origin is lifted off emitters
    Rgb power;                      ///< W: emitted power divided by the density of this choice
    std::uint16_t light_group = 0;  ///< of the light
    std::optional<EmitterSample> emitter;  ///< where the ray left, for area lights
    Vec3 emitter_normal{0};                ///< of the side it left from
    float pdf_point = 0.0f;                ///< of the point on that side, m^-2
};

/// Draws a light by power and a ray from it: cosine-distributed from emissive triangles, uniform
/// from point lights and inside spot cones, parallel from directional lights, by luminance from the
/// environment. Always takes five numbers. Origins are lifted off emitters. The table must not be
/// empty.
Emission sample_emission(const LightTable& lights, PathNumbers& numbers);

namespace detail {

inline Emission emit_from_triangle(EmitterSample s, float probability, Vec2 uv) {
    Emission e;
    const float sides = s.both_sides ? 2.0f : 1.0f;
    // One number serves side and direction: the half of [0, 1) picks the side.
    const bool back = s.both_sides && uv.x >= 0.5f;
    if (s.both_sides) uv.x = 2.0f * uv.x - (back ? 1.0f : 0.0f);
    e.emitter_normal = back ? -s.normal : s.normal;
    e.pdf_point = probability * s.pdf_area / sides;
    e.power = s.radiance * (pi / e.pdf_point);
    e.ray = {lift(s.position, e.emitter_normal, s.offset),
             Frame::around(e.emitter_normal).to_world(square_to_cosine_hemisphere(uv))};
    e.light_group = s.light_group;
    e.emitter = s;
    return e;
}

inline Emission emit_from_point(const PointLight& l, float probability, Vec2 uv) {
    Emission e;
    e.ray = {l.position, square_to_sphere(uv)};
    e.power = l.intensity * (1.0f / (sphere_pdf() * probability));
    e.light_group = l.light_group;
    return e;
}

inline Emission emit_from_spot(const SpotLight& l, float probability, Vec2 uv) {
    Emission e;
    e.ray = {l.position, Frame::around(l.direction).to_world(square_to_cone(uv, l.cos_outer))};
    e.power =
        l.intensity * (spot_falloff(l, e.ray.direction) / (cone_pdf(l.cos_outer) * probability));
    e.light_group = l.light_group;
    return e;
}

/// Light that travels along `direction` and brings `irradiance`, over the choice's density.
inline Emission emit_from_far(Vec3 direction, Rgb irradiance, const LightTable& lights, Vec2 uv) {
    Emission e;
    const float radius = lights.radius();
    const Frame frame = Frame::around(direction);
    const Vec2 disc = radius * square_to_disc(uv);
    const Vec3 on_disc = disc.x * frame.tangent + disc.y * frame.bitangent;
    e.ray = {lights.centre() + on_disc - 2.0f * radius * direction, direction};
    e.power = irradiance * (pi * radius * radius);
    return e;
}

inline Emission emit_from_environment(const LightTable& lights, float probability, Vec2 direction,
                                      Vec2 uv) {
    const EnvironmentView<Space::host> environment = lights.environment().view();
    const EnvironmentSample s = environment.sample(direction);
    Emission e =
        emit_from_far(-s.direction, s.radiance * (1.0f / (s.pdf * probability)), lights, uv);
    e.light_group = environment.light_group;
    return e;
}

}  // namespace detail

inline Emission sample_emission(const LightTable& lights, PathNumbers& numbers) {
    std::uint32_t light = lights.sample_light(numbers.next());
    const Vec2 on_light = numbers.next_2d();
    const Vec2 uv = numbers.next_2d();
    const float probability = lights.light_probability(light);
    const auto triangles = static_cast<std::uint32_t>(lights.emissive_triangles().size());
    if (light < triangles)
        return detail::emit_from_triangle(lights.point_on(light, on_light), probability, uv);
    light -= triangles;
    if (light < lights.point_lights().size())
        return detail::emit_from_point(lights.point_lights()[light], probability, uv);
    light -= static_cast<std::uint32_t>(lights.point_lights().size());
    if (light < lights.spot_lights().size())
        return detail::emit_from_spot(lights.spot_lights()[light], probability, uv);
    light -= static_cast<std::uint32_t>(lights.spot_lights().size());
    if (light == lights.directional_lights().size())
        return detail::emit_from_environment(lights, probability, on_light, uv);
    const DirectionalLight& sun = lights.directional_lights()[light];
    Emission e = detail::emit_from_far(sun.direction, sun.irradiance * (1.0f / probability), lights,
                                       on_light);
    e.light_group = sun.light_group;
    return e;
}

}  // namespace mir
