// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_radiance.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/shading/material_params.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mir {

/// Light of the lamps and the environment that discs reflect, for light_surfels(), at up to sixteen
/// places of each disc, by paths of one reflection: light samples and scattered directions weighed,
/// so that a lamp that nearly touches a disc is not found by rare samples alone. Lights without
/// extent count exactly at each place.
template <Bsdf B, RayCaster R, Visibility V>
class SurfelDirectLight {
 public:
    using Tracer = PathTracer<B, R, V>;    ///< what finds light
    using World = typename Tracer::World;  ///< what it needs of the scene, which must outlive it

    /// `samples` of each side, at least 1.
    /// @throws Error(invalid_argument) when there are more than a million.
    SurfelDirectLight(const World& world, std::uint32_t samples, std::uint64_t seed)
        : places_(std::clamp(samples, 1u, most_places)),
          tracer_(world, options((samples + places_ - 1) / places_)),
          seed_(seed) {}

    /// W m^-2 sr^-1. Safe to call from any thread.
    [[nodiscard]] Rgb operator()(const SurfelFace& face, std::uint64_t number) const {
        Random random(seed_, Stream::surfel_light, number);
        const Vec2 shift = Random(seed_, Stream::surfel_place, number).next_2d();
        const Vec3 normal = face.hit.normal;
        const auto params = material_params(
            MaterialFactors{.base_color = face.surface.bsdf.reflectance, .specular = 0.0f}, B{});
        std::array<RgbSum, 2> bounces{};
        for (std::uint32_t i = 0; i < places_; ++i)
            tracer_.trace({{face.place(point(shift, i)), normal}, {normal, normal, {}, params}},
                          random, bounces);
        return (bounces[1] * (1.0 / places_)).rgb();
    }

 private:
    static constexpr std::uint32_t most_places = 16;

    static PathTracerOptions options(std::uint32_t samples) {
        PathTracerOptions o;
        o.light_samples = samples;
        o.max_bounce = 1;
        return o;
    }
    /// Spread evenly, and not as the numbers of lamp samples are.
    [[nodiscard]] Vec2 point(Vec2 shift, std::uint32_t i) const {
        const float y = shift.y + 0.618034f * static_cast<float>(i);
        return {(static_cast<float>(i) + shift.x) / static_cast<float>(places_), y - std::floor(y)};
    }

    std::uint32_t places_;
    Tracer tracer_;
    std::uint64_t seed_;
};

}  // namespace mir
