// SPDX-License-Identifier: MIT
#pragma once

#include "mir/reference/bound_split.hpp"
#include "mir/reference/light_search.hpp"

#include <cstdint>
#include <limits>
#include <optional>

namespace mir {

/// Which paths, by their first edge behind the luxel. VPLs and light samples bring those where it
/// is straight.
enum class PathPart {
    all,       ///< every path
    gathered,  ///< no mirror and no body of glass lies on it
    residual   ///< one does
};

/// How paths are traced; the estimator is described in docs/reference.md.
struct PathTracerOptions {
    LightSearch light = LightSearch::mis;  ///< how lamps and environment are found
    /// Points on emissive triangles, and directions towards the environment, at the first vertex.
    /// Every later vertex takes one: the cost is linear in `light_samples` and `directions`, not
    /// their product.
    std::uint32_t light_samples = 1;
    std::uint32_t directions = 1;  ///< paths that go on from the first vertex
    /// Largest number of scattering events, 1..254; none: roulette alone ends paths.
    std::optional<std::uint8_t> max_bounce = std::nullopt;
    std::uint8_t roulette_from = 3;  ///< first vertex where a path may end by chance; 255: never
    /// Largest geometry term of the first two vertices, m^-2, if paths scatter at both. It is what
    /// VplShading gives to the light of VPLs. Emission and other direct light are not bounded.
    float bound = std::numeric_limits<float>::max();
    BoundPart part = BoundPart::kept;  ///< `removed`: the light that the bound takes, alone
    bool bound_lamps = false;          ///< direct light of emissive triangles is bounded too
    PathPart paths = PathPart::all;    ///< which of them are wanted
};

}  // namespace mir
