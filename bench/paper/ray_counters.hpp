// SPDX-License-Identifier: MIT
#pragma once

#include "paper_scene.hpp"

namespace mirpaper {

/// What the shadow rays of a scene have to do: why one scene is faster than another.
struct RayCounters {
    double facing = 0.0;     ///< share of luxel-VPL pairs that face each other and need a ray
    double visible = 0.0;    ///< share of those that see each other
    double nodes = 0.0;      ///< inner nodes per ray
    double leaves = 0.0;     ///< leaves per ray
    double triangles = 0.0;  ///< triangles tested per ray
    /// Mean steps of a ray over those of the longest one among 32 neighbouring luxels, those that
    /// need no ray counted as none: what lock step leaves of 32 lanes, 0..1.
    double lanes_busy = 0.0;
    std::uint64_t rays = 0;  ///< looked at
};

/// Walks a sample of the rays on the host, from the VPL: about `groups` runs of 32 neighbouring
/// luxels, spread over the image, and all VPLs.
/// @throws Error(internal) when a counted ray and the library's own disagree.
RayCounters count_rays(const PaperScene& scene, const mir::VplList& vpls, std::uint32_t groups,
                       Executor& executor);

}  // namespace mirpaper
