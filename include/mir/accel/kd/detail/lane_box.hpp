// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/lanes.hpp"

#include <cmath>
#include <limits>

namespace mir::detail {

/// Axis-aligned box in registers; the spare lanes mean nothing. Inverted until something is added.
struct LaneBox {
    Float4 low = all_lanes(std::numeric_limits<float>::infinity());
    Float4 high = all_lanes(-std::numeric_limits<float>::infinity());

    void add(Float4 other_low, Float4 other_high) {
        low = smaller_lanes(other_low, low);
        high = larger_lanes(other_high, high);
    }
    void add(const LaneBox& other) { add(other.low, other.high); }
};

/// Half the surface of a nonempty box. Lengths are multiplied by `scale` so that nothing
/// overflows.
inline float half_area(const LaneBox& box, float scale) {
    const Float4 w = (box.high - box.low) * all_lanes(scale);
    const Float4 sides = w * next_axes(w);
    return sides[0] + sides[1] + sides[2];
}

/// Scale at which half the surface of a box is 1.
inline float area_scale(const LaneBox& box) {
    const Float4 extent = box.high - box.low;
    const float widest = larger(extent[0], larger(extent[1], extent[2]));
    return widest > 0.0f ? 1.0f / (widest * std::sqrt(half_area(box, 1.0f / widest))) : 1.0f;
}

}  // namespace mir::detail
