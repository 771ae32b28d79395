// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_radiance.hpp"
#include "mir/shading/environment_light.hpp"
#include "mir/shading/scene_light.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

/// Light of the lamps that discs reflect, for light_surfels(), at up to sixteen places of each
/// disc: of emissive triangles by `samples` points chosen by power, of the environment by as many
/// directions, shared out among the places; of lights without extent at each of them.
template <Visibility V>
class SurfelDirectLight {
 public:
    /// `lights` must outlive it.
    SurfelDirectLight(const LightTable& lights, V visibility, std::uint32_t samples,
                      std::uint64_t seed)
        : places_(std::clamp(samples, 1u, most_places)),
          emitters_(lights, visibility, (samples + places_ - 1) / places_),
          deltas_(lights, visibility),
          environment_(lights, visibility, (samples + places_ - 1) / places_),
          seed_(seed) {}

    /// W m^-2 sr^-1. Safe to call from any thread.
    [[nodiscard]] Rgb operator()(const SurfelFace& face, std::uint64_t number) const {
        const Random random(seed_, Stream::surfel_light, number);
        const Vec2 shift = Random(seed_, Stream::surfel_place, number).next_2d();
        Rgb sum;
        for (std::uint32_t i = 0; i < places_; ++i) {
            const Hit hit{face.place(point(shift, i)), face.hit.normal};
            sum += emitters_(hit, face.surface, {places_, i}, random) + deltas_(hit, face.surface) +
                   environment_(hit, face.surface, {places_, i}, random);
        }
        return sum * (1.0f / static_cast<float>(places_));
    }

 private:
    static constexpr std::uint32_t most_places = 16;

    /// Spread evenly, and not as the numbers of lamp samples are.
    [[nodiscard]] Vec2 point(Vec2 shift, std::uint32_t i) const {
        const float y = shift.y + 0.618034f * static_cast<float>(i);
        return {(static_cast<float>(i) + shift.x) / static_cast<float>(places_), y - std::floor(y)};
    }

    std::uint32_t places_;
    EmitterLight<Lambert, V> emitters_;
    DeltaLight<Lambert, V> deltas_;
    EnvironmentLight<Lambert, V> environment_;
    std::uint64_t seed_;
};

}  // namespace mir
