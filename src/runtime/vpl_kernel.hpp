// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shading/vpl_shading.hpp"

namespace mir {

/// How VPLs light luxels, whatever the model of their surfaces.
struct VplKernel {
    /// VplShading, RemovedByBound, VslShading, GlossyShading and what that leaves out.
    enum class Kind { points, removed, spheres, lobes, removed_of_lobes };
    Kind kind;    ///< spheres and lobes: after keep_radii() or keep_lobes() of the frame
    float bound;  ///< largest geometry term, m^-2; of no meaning for spheres
};

/// Calls use(shading) with the Shading of points or of removed light. Returns what it
/// returns.
template <Bsdf B, class Use>
auto with_shading(VplKernel kernel, const Use& use) {
    if (kernel.kind == VplKernel::Kind::removed) return use(RemovedByBound<B>{kernel.bound});
    return use(VplShading<B>{kernel.bound});
}

}  // namespace mir
