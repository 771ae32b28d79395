// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mir {

/// Whole turns from (1, 0) to the direction `d`, in [-1/2, 1/2]. The inverse of unit_circle(), of a
/// vector of any usual length; 0 of (0, 0). Absolute error below 6e-8. Made of products, sums and
/// one quotient in a fixed order, so equal in bits on every machine where none are fused: the
/// arc tangent of a math library is not, and one differing bit finds another texel.
MIR_HD constexpr float circle_turns(Vec2 d) {
    const float x = d.x < 0.0f ? -d.x : d.x;
    const float y = d.y < 0.0f ? -d.y : d.y;
    const float high = x < y ? y : x;
    const float low = x < y ? x : y;
    if (!(high > 0.0f)) return 0.0f;
    // Beyond tan(pi / 8) the angle to the diagonal is the smaller one.
    const bool is_steep = low > 0.414213562f * high;
    const float r = is_steep ? (low - high) / (low + high) : low / high;
    const float r2 = r * r;
    // Best polynomial for atan(r) / (2 pi) where |r| <= tan(pi / 8), off by 6e-10.
    float turns = 0.012309954582434769f;
    turns = turns * r2 - 0.021891473712109102f;
    turns = turns * r2 + 0.0317704568092359f;
    turns = turns * r2 - 0.05304985055757934f;
    turns = turns * r2 + 0.15915492806704284f;
    turns = turns * r;
    if (is_steep) turns = turns + 0.125f;
    if (x < y) turns = 0.25f - turns;
    if (d.x < 0.0f) turns = 0.5f - turns;
    return d.y < 0.0f ? -turns : turns;
}

}  // namespace mir
