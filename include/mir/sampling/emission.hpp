// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/path_numbers.hpp"
#include "mir/scene/light_table.hpp"

namespace mir {

/// The start of a light path: a ray and the power it stands for.
struct Emission {
    Ray ray;                        ///< leaves the light; its origin is lifted off surfaces
    Rgb power;                      ///< W: emitted power divided by the density of this choice
    std::uint16_t light_group = 0;  ///< of the light
    bool is_lamp = false;           ///< the ray left a surface of the scene: `emitter`
    LightPoint emitter;             ///< where it left; means nothing unless is_lamp
    float pdf_point = 0.0f;         ///< of that point on its side, m^-2
};

namespace detail {

/// A ray of a light that was itself chosen with this probability.
template <LightSource L>
MIR_HD Emission emission_of(const L& source, float probability, Vec2 on_light, Vec2 uv) {
    // One number serves side and direction: the half of [0, 1) picks the side.
    const LightPoint from = source.start(on_light, uv.x);
    if (from.sides == 2) uv.x = 2.0f * uv.x - (uv.x >= 0.5f ? 1.0f : 0.0f);
    // A direction without extent takes no numbers: the first are those of its ray.
    if (L::origin == LightOrigin::outside && !L::has_extent) uv = on_light;
    Emission e;
    e.ray = source.ray(from.position, from.normal, uv);
    e.power = source.flux(from, e.ray.direction, probability);
    e.light_group = from.light_group;
    if (L::origin != LightOrigin::surface) return e;
    e.is_lamp = true;
    e.emitter = from;
    e.pdf_point = probability * from.pdf_start();
    return e;
}

}  // namespace detail

/// Draws a light by power and a ray from it, as its LightSource does. Always takes five numbers.
/// The table must not be empty; `geometry` is that of its scene.
template <Space S>
MIR_HD Emission sample_emission(const LightTableView<S>& lights, const GeometryView<S>& geometry,
                                PathNumbers& numbers) {
    const std::uint32_t light = lights.sample_light(numbers.next());
    const Vec2 on_light = numbers.next_2d();
    const Vec2 uv = numbers.next_2d();
    return lights.visit(geometry, light, [&](const auto& source) {
        return detail::emission_of(source, lights.light_probability(light), on_light, uv);
    });
}

/// The same of the lights of the host.
inline Emission sample_emission(const LightTable& lights, PathNumbers& numbers) {
    return sample_emission(lights.view(), lights.geometry().view(), numbers);
}

}  // namespace mir
