// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/space.hpp"

namespace mirtest {

/// Visibility without any obstacle: for closed forms of unoccluded light.
struct FreeSight {
    static constexpr mir::Space space = mir::Space::any;
    [[nodiscard]] bool visible(mir::Vec3 /*a*/, mir::Vec3 /*b*/) const { return true; }
};

}  // namespace mirtest
