// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mirtest {

/// A segment of which tests ask whether its ends, in metres, see each other. May be passed to a
/// kernel.
struct SegmentEnds {
    mir::Vec3 from{0};
    mir::Vec3 to{0};
};

}  // namespace mirtest
