// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mir {

/// Point of the unit circle after `turns` whole turns from (1, 0). Cosine and sine of 2 pi turns.
/// Absolute error of either below 1.5e-7 for |turns| < 2^21; exact at multiples of a quarter. Made
/// of products and sums in a fixed order, so equal in bits on every machine where none are fused
/// (docs/embedding.md): the sine and cosine of a math library are not, and one differing bit sends
/// a Markov chain elsewhere.
MIR_HD constexpr Vec2 unit_circle(float turns) {
    const int quarters = static_cast<int>(4.0f * turns + (turns < 0.0f ? -0.5f : 0.5f));
    const float r = turns - 0.25f * static_cast<float>(quarters);  // exact, |r| <= 1/8
    const float r2 = r * r;
    // Taylor series of sin(2 pi r) and cos(2 pi r); the next terms are below 2e-9 and 3e-8.
    float s = 42.058693944897655f;
    s = s * r2 - 76.705859753061385f;
    s = s * r2 + 81.605249276075054f;
    s = s * r2 - 41.341702240399760f;
    s = s * r2 + 6.2831853071795865f;
    s = s * r;
    float c = 60.244641371876661f;
    c = c * r2 - 85.456817206693725f;
    c = c * r2 + 64.939394022668290f;
    c = c * r2 - 19.739208802178717f;
    c = c * r2 + 1.0f;
    const bool is_across = quarters % 2 != 0;
    const float x = is_across ? s : c;
    const float y = is_across ? c : s;
    const int quadrant = quarters & 3;
    return {quadrant == 1 || quadrant == 2 ? -x : x, quadrant >= 2 ? -y : y};
}

}  // namespace mir
