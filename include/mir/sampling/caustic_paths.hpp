// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/extent.hpp"
#include "mir/sampling/light_path_options.hpp"
#include "mir/scene/camera_optics.hpp"

#include <cstdint>

namespace mir {

/// What a light path brings to one luxel.
struct CausticSplat {
    std::uint32_t x = 0;      ///< of the luxel, in the whole luxel image
    std::uint32_t y = 0;      ///< the same
    std::uint8_t bounce = 1;  ///< scattering events of the path, mirrors and glass not counted
    Rgb radiance;             ///< to be added, W m^-2 sr^-1
};

/// Who looks at caustics.
struct CausticView {
    CameraOptics optics;  ///< of the camera
    float aspect = 1.0f;  ///< width / height of the film
    Extent luxels;        ///< of the whole luxel image
};

/// Which light paths a CausticTracer traces.
struct CausticPaths {
    std::uint64_t paths = 0;               ///< how many
    std::uint8_t max_bounce = 32;          ///< largest number of scattering events
    Sequence sequence = Sequence::random;  ///< numbers that they are made of
    std::uint64_t seed = 0;                ///< of the numbers
};

}  // namespace mir
