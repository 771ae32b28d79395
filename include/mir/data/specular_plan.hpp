// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// How a luxel draws the first event of its specular chain. The luxels of a pixel share the events
/// out, so that each that glass can send light by has luxels of its own.
struct SpecularPlan {
    float first = -1.0f;  ///< number in [0, 1) that draws it; negative: one of the ray's own
    float least = 0.0f;   ///< probabilities of events are multiples of it, 0..0.25; 0: any
};

}  // namespace mir
