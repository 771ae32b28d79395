// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/share_estimate.hpp"
#include "runtime/render_frame.hpp"

namespace mir {

/// What VPLs do not bring of the light that they stand for.
struct MissingShares {
    ShareEstimate cut;      ///< scattered more often than RenderSettings::bounce_limit(), of what
                            ///< the bound leaves
    ShareEstimate removed;  ///< by the bound, of what is scattered no more often
};

/// Measures what a render by VPLs leaves out under `bound`, m^-2. The largest number means none.
/// Paths of the reference from two thousand places spread over the image tell it, because VPLs know
/// nothing of longer paths than theirs, and only the few that lie next to a luxel tell what the
/// bound removes. Indirect light counts, with DirectLight::vpl direct light too. Surfaces that
/// paths meet reflect with their full BSDF. By rays of the host. Bits depend on scene, settings and
/// seed alone.
[[nodiscard]] MissingShares missing_light(RenderFrame& frame, float bound);

}  // namespace mir
