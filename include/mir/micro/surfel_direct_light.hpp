// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_radiance.hpp"
#include "mir/shading/environment_light.hpp"
#include "mir/shading/scene_light.hpp"

namespace mir {

/// Light of the lamps that discs reflect, for light_surfels(): of emissive triangles by `samples`
/// points chosen by power, of the environment by as many directions, of lights without extent
/// exactly, all at the centre of the disc.
template <Visibility V>
class SurfelDirectLight {
 public:
    /// `lights` must outlive it.
    SurfelDirectLight(const LightTable& lights, V visibility, std::uint32_t samples,
                      std::uint64_t seed)
        : emitters_(lights, visibility, samples),
          deltas_(lights, visibility),
          environment_(lights, visibility, samples),
          seed_(seed) {}

    /// W m^-2 sr^-1. Safe to call from any thread.
    [[nodiscard]] Rgb operator()(const SurfelFace& face, std::uint64_t number) const {
        const Random random(seed_, Stream::surfel_light, number);
        return emitters_(face.hit, face.surface, {}, random) + deltas_(face.hit, face.surface) +
               environment_(face.hit, face.surface, {}, random);
    }

 private:
    EmitterLight<Lambert, V> emitters_;
    DeltaLight<Lambert, V> deltas_;
    EnvironmentLight<Lambert, V> environment_;
    std::uint64_t seed_;
};

}  // namespace mir
