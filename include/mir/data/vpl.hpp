// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <cstdint>

namespace mir {

/// A geometric VPL, its path VPLs already summed. It is a point that shines into the hemisphere of
/// its geometric normal with radiant intensity J cos(theta).
struct Vpl {
    Vec3 position{0};  ///< lifted off the surface, metres
    Vec3 normal{0};    ///< unit geometric normal
    Rgb intensity;     ///< J, radiant intensity along the normal, W sr^-1
};

/// Where the light of a VPL comes from.
enum class VplKind : std::uint8_t {
    emitter,    ///< a point of a light source: direct light
    reflective  ///< a point that reflects: indirect light
};

/// Which point of a surface a geometric VPL is, and how much stands on it. Kernels that light
/// luxels do not read it.
struct VplOrigin {
    VplKind kind = VplKind::reflective;  ///< part of the point's identity
    std::uint32_t triangle = 0;          ///< identity of the point: triangle and barycentrics
    Vec2 barycentrics{0};                ///< weights of the second and third corner
    float multiplicity = 1.0f;  ///< recorded states that share this point; VplList counts them
};

/// True when two path VPLs may belong to one geometric VPL. Identity is the triangle and the
/// barycentrics copied from the sampler's state, never a distance.
MIR_HD inline bool same_place(const VplOrigin& a, const VplOrigin& b) {
    return a.triangle == b.triangle && a.barycentrics == b.barycentrics && a.kind == b.kind;
}

}  // namespace mir
