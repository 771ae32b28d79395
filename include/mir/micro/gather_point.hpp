// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/data/luxel.hpp"

namespace mir {

/// A luxel that gathers light. `Surface` is what it tells shading.
template <class Surface>
struct GatherPoint {
    Hit hit;                              ///< empty: nothing gathers
    Surface surface;                      ///< not looked at where the hit is empty
    Random random{0, Stream::gather, 0};  ///< numbers of the luxel
};

}  // namespace mir
