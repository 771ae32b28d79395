// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/strict_float.hpp"

namespace mir::detail {

/// t of a plane on one axis is split * inverse - offset. Aligned so that a walk, which looks a step
/// up by axis, fetches it as one word.
struct alignas(8) AxisStep {
    float inverse = 0.0f;
    float offset = 0.0f;
};

/// What a component of zero is taken for, metres. So short that it moves a point by less than 2^-24
/// of the rounding of coordinates, so long that coordinates times its inverse stay finite. The
/// second term only keeps scenes below 1e-18 m from overflowing, where no product of two distances
/// differs from zero, and so no triangle is crossed.
MIR_HD inline float shortest_step(float reach) { return larger(reach * 0x1p-50f, 0x1p-110f); }

/// 1 / step. Keeps it finite: a step shorter than `shortest` becomes one of that length, with the
/// sign of `step`.
MIR_HD inline float inverse_step(float step, float shortest) {
    return loose::reciprocal(copysignf(larger(fabsf(step), shortest), step));
}

MIR_HD inline AxisStep axis_step(float from, float to, float shortest) {
    const float inverse = inverse_step(strict::sub(to, from), shortest);
    return {inverse, strict::mul(from, inverse)};
}

/// Step to a face `size` >= 0 metres away on the side of `sign`, +-1.
MIR_HD inline AxisStep face_step(float from, float size, float sign, float shortest) {
    const float inverse = sign * loose::reciprocal(larger(size, shortest));
    return {inverse, strict::mul(from, inverse)};
}

}  // namespace mir::detail
