// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_radiance.hpp"
#include "mir/shading/scene_light.hpp"

namespace mir {

/// Light of the lamps that discs reflect, for light_surfels(): of emissive triangles by `samples`
/// points chosen by power, of lights without extent exactly, both at the centre of the disc.
template <Visibility V>
class SurfelDirectLight {
 public:
    /// `lights` must outlive it.
    SurfelDirectLight(const LightTable& lights, V visibility, std::uint32_t samples,
                      std::uint64_t seed)
        : emitters_(lights, visibility, samples), deltas_(lights, visibility), seed_(seed) {}

    /// W m^-2 sr^-1. Safe to call from any thread.
    [[nodiscard]] Rgb operator()(const SurfelFace& face, std::uint64_t number) const {
        const Random random(seed_, Stream::surfel_light, number);
        return emitters_(face.hit, face.surface, {}, random) + deltas_(face.hit, face.surface);
    }

 private:
    EmitterLight<Lambert, V> emitters_;
    DeltaLight<Lambert, V> deltas_;
    std::uint64_t seed_;
};

}  // namespace mir
