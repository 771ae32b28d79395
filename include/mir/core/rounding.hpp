// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/instruction_set.hpp"
#include "mir/core/math.hpp"
#include "mir/core/rgb.hpp"
#include "mir/core/strict_float.hpp"

#include <type_traits>

namespace mir {

/// Sums of products as they are written: products are rounded before they are added. Any processor
/// is as fast at it as at anything.
struct SeparateRounding {
    /// a * b + c, rounded twice.
    [[nodiscard]] MIR_HD static float mul_add(float a, float b, float c) { return a * b + c; }
};

/// Sums of products that are rounded once. That is two thirds of the operations, with the same bits
/// on every processor and device. Code for any x86-64, which has no such instruction, calls a
/// function of the C library for each: host loops should use run_with(), and FusedRoundingFor of
/// its `set`.
struct FusedRounding {
    /// a * b + c, rounded once.
    [[nodiscard]] MIR_HD static float mul_add(float a, float b, float c) {
        return strict::mul_add(a, b, c);
    }
};

/// The bits of FusedRounding by double precision alone. For processors without fused operations,
/// sums below 2^127, and products that do not underflow in double.
struct SimulatedFusedRounding {
    /// a * b + c, rounded once. The product of two floats is a double; the sum is one apart from
    /// `error`. It decides where the sum lies in the middle of two floats, and nowhere else.
    /// Not inlined: loops in which it is take the compiler twice as long, for processors of before
    /// 2013 alone.
    [[nodiscard, gnu::noinline]] MIR_HD static float mul_add(float a, float b, float c) {
        const double product = static_cast<double>(a) * static_cast<double>(b);
        const double addend = c;
        const double sum = product + addend;
        const double added = sum - product;
        const double error = (product - (sum - added)) + (addend - added);
        const auto near = static_cast<float>(sum);
        const double rest = sum - static_cast<double>(near);
        const double other = static_cast<double>(near) + 2.0 * rest;
        const auto far = static_cast<float>(other);
        const bool in_the_middle = static_cast<double>(far) == other;
        const bool is_beyond = rest * error > 0.0;
        return (static_cast<int>(in_the_middle) & static_cast<int>(is_beyond)) != 0 ? far : near;
    }
};

/// FusedRounding in its fastest form for host loops compiled for `Set`.
template <InstructionSet Set>
using FusedRoundingFor =
#if defined(__FP_FAST_FMAF)
    FusedRounding;
#else
    std::conditional_t<Set == InstructionSet::baseline, SimulatedFusedRounding, FusedRounding>;
#endif

/// a . b
template <class Rounding>
[[nodiscard, gnu::always_inline]] MIR_HD inline float dot(Vec3 a, Vec3 b) {
    return Rounding::mul_add(a.z, b.z, Rounding::mul_add(a.y, b.y, a.x * b.x));
}

/// s v + w
template <class Rounding>
[[nodiscard, gnu::always_inline]] MIR_HD inline Vec3 mul_add(float s, Vec3 v, Vec3 w) {
    return {Rounding::mul_add(s, v.x, w.x), Rounding::mul_add(s, v.y, w.y),
            Rounding::mul_add(s, v.z, w.z)};
}

/// s c + d, channel by channel.
template <class Rounding>
[[nodiscard, gnu::always_inline]] MIR_HD inline Rgb mul_add(float s, Rgb c, Rgb d) {
    return {Rounding::mul_add(s, c.r, d.r), Rounding::mul_add(s, c.g, d.g),
            Rounding::mul_add(s, c.b, d.b)};
}

}  // namespace mir
