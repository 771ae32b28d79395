// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"

namespace mir {

/// False for a luxel that sees nothing, and for one that reflects nothing.
template <Shading F>
[[nodiscard]] MIR_HD bool can_be_lit(const F& shade, const Hit& hit,
                                     const typename F::Surface& surface) {
    if (is_empty(hit)) return false;
    if constexpr (SurfaceSelectiveShading<F>)
        return shade.reflects(surface);
    else
        return true;
}

}  // namespace mir
