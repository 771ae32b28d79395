// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_radiance.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/shading/material_params.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mir {

/// Light of the lamps and the environment on discs, for light_surfels(). At up to sixteen places of
/// each patch, by paths of one reflection: light samples and scattered directions weighed, so that
/// a lamp that nearly touches a patch is not found by rare samples alone. Lights without extent
/// count exactly at each place.
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

    /// What light_surfels() asks for, W m^-2 sr^-1. Safe to call from any thread.
    [[nodiscard]] Rgb operator()(const SurfelFace& face, std::uint64_t number) const {
        Random random(seed_, Stream::surfel_light, number);
        return light(face, number, 0, places_, random);
    }

    /// The same of the quarters of the discs, in the order of the tree. Places fewer than four tell
    /// of all of them.
    [[nodiscard]] std::array<Rgb, 4> quarters(const SurfelFace& face, std::uint64_t number) const {
        Random random(seed_, Stream::surfel_light, number);
        std::array<Rgb, 4> parts;
        if (places_ < 4) {
            parts.fill(light(face, number, 0, places_, random));
            return parts;
        }
        for (std::uint32_t i = 0; i < 4; ++i)
            parts[i] = light(face, number, i * places_ / 4, (i + 1) * places_ / 4, random);
        return parts;
    }

 private:
    static constexpr std::uint32_t most_places = 16;

    static PathTracerOptions options(std::uint32_t samples) {
        PathTracerOptions o;
        o.light_samples = samples;
        o.max_bounce = 1;
        return o;
    }
    /// In the mean of places [first, last).
    [[nodiscard]] Rgb light(const SurfelFace& face, std::uint64_t number, std::uint32_t first,
                            std::uint32_t last, Random& random) const {
        const Vec2 shift = Random(seed_, Stream::surfel_place, number).next_2d();
        const auto white =
            material_params(MaterialFactors{.base_color = {1, 1, 1}, .specular = 0.0f}, B{});
        std::array<RgbSum, 2> bounces{};
        for (std::uint32_t i = first; i < last; ++i) {
            const Hit hit = face.place(point(shift, i));
            tracer_.trace({hit, {hit.normal, hit.normal, {}, white}}, random, bounces);
        }
        return (bounces[1] * (1.0 / (last - first))).rgb();
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
