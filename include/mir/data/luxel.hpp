// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

namespace mir {

/// What visibility needs to know about a luxel. The position is already lifted off the surface
/// (core/ray.hpp); the geometric normal has unit length and faces the viewer.
struct Hit {
    Vec3 position{0};  ///< metres
    Vec3 normal{0};    ///< zero: the luxel sees nothing
};

/// What shading needs to know about a luxel, and visibility does not. The split is the one that
/// makes RCVP possible (section 5.2 of the paper).
template <class Params>
struct Surface {
    Vec3 normal{0};  ///< unit shading normal, on the viewer's side
    Vec3 wo{0};      ///< unit direction towards the viewer
    Rgb emission;    ///< radiance emitted towards the viewer, W m^-2 sr^-1
    Params bsdf;     ///< of the material at this point
};

/// True for a luxel whose camera ray left the scene, and for padding. No branches: loops over lanes
/// ask it.
MIR_HD inline bool is_empty(const Hit& h) {
    return (static_cast<int>(h.normal.x == 0.0f) & static_cast<int>(h.normal.y == 0.0f) &
            static_cast<int>(h.normal.z == 0.0f)) != 0;
}

}  // namespace mir
