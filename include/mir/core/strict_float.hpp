// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cmath>

namespace mir::loose {

// Operations whose last bits may differ between host and device: for decisions that carry their own
// margin, such as the order in which a traversal visits cells.

/// 1 / a with a relative error of at most 2^-22. `a` between 2^-120 and 2^120 in size.
[[nodiscard]] MIR_HD inline float rough_reciprocal(float a) {
#if defined(__CUDA_ARCH__)
    float estimate = 0.0f;
    asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(estimate) : "f"(a));
    return estimate;
#else
    return 1.0f / a;
#endif
}

/// 1 / a with a relative error below 2^-23. `a` between 2^-120 and 2^120 in size.
[[nodiscard]] MIR_HD inline float reciprocal(float a) {
#if defined(__CUDA_ARCH__)
    const float estimate = rough_reciprocal(a);
    return __fmaf_rn(estimate, __fmaf_rn(-a, estimate, 1.0f), estimate);
#else
    return 1.0f / a;
#endif
}

/// 1 / sqrt(a) with a relative error below 2^-21; `a` between 2^-120 and 2^120.
[[nodiscard]] MIR_HD inline float inverse_root(float a) {
#if defined(__CUDA_ARCH__)
    float estimate = 0.0f;
    asm("rsqrt.approx.ftz.f32 %0, %1;" : "=f"(estimate) : "f"(a));
    return estimate;
#else
    return 1.0f / std::sqrt(a);
#endif
}

/// a * b + c, rounded once or twice.
[[nodiscard]] MIR_HD inline float mul_add(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
    return __fmaf_rn(a, b, c);
#else
    return a * b + c;
#endif
}

/// a * b - c, rounded once or twice.
[[nodiscard]] MIR_HD inline float mul_sub(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
    return __fmaf_rn(a, b, -c);
#else
    return a * b - c;
#endif
}

}  // namespace mir::loose

namespace mir::strict {

// Products, sums and quotients that are rounded one by one, to nearest even, in every compilation.
// A compiler that may contract turns a * b + c into one fused operation with one rounding less;
// bits of results that are compared with zero would then depend on who compiled them. On the device
// the intrinsics below are never contracted, whatever -fmad says. On the host plain operators do:
// host code of the library is compiled with -ffp-contract=off. Host and device read different
// source here, in lane_group.hpp, in load_whole.hpp, and in the tests of nodes of shaft/; they
// compute the same, or err on the same side.

/// a * b, rounded once.
[[nodiscard]] MIR_HD inline float mul(float a, float b) {
#if defined(__CUDA_ARCH__)
    return __fmul_rn(a, b);
#else
    return a * b;
#endif
}

/// a + b, rounded once.
[[nodiscard]] MIR_HD inline float add(float a, float b) {
#if defined(__CUDA_ARCH__)
    return __fadd_rn(a, b);
#else
    return a + b;
#endif
}

/// a - b, rounded once.
[[nodiscard]] MIR_HD inline float sub(float a, float b) {
#if defined(__CUDA_ARCH__)
    return __fsub_rn(a, b);
#else
    return a - b;
#endif
}

/// a / b, rounded once.
[[nodiscard]] MIR_HD inline float div(float a, float b) {
#if defined(__CUDA_ARCH__)
    return __fdiv_rn(a, b);
#else
    return a / b;
#endif
}

/// a * b + c, rounded once. Code for hosts without such an instruction calls the C library.
[[nodiscard]] MIR_HD inline float mul_add(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
    return __fmaf_rn(a, b, c);
#else
    return __builtin_fmaf(a, b, c);
#endif
}

/// a * b, rounded once.
[[nodiscard]] MIR_HD inline double mul(double a, double b) {
#if defined(__CUDA_ARCH__)
    return __dmul_rn(a, b);
#else
    return a * b;
#endif
}

/// a + b, rounded once.
[[nodiscard]] MIR_HD inline double add(double a, double b) {
#if defined(__CUDA_ARCH__)
    return __dadd_rn(a, b);
#else
    return a + b;
#endif
}

/// a - b, rounded once.
[[nodiscard]] MIR_HD inline double sub(double a, double b) {
#if defined(__CUDA_ARCH__)
    return __dsub_rn(a, b);
#else
    return a - b;
#endif
}

/// a / b, rounded once.
[[nodiscard]] MIR_HD inline double div(double a, double b) {
#if defined(__CUDA_ARCH__)
    return __ddiv_rn(a, b);
#else
    return a / b;
#endif
}

/// Square root, rounded once.
[[nodiscard]] MIR_HD inline double sqrt(double a) {
#if defined(__CUDA_ARCH__)
    return __dsqrt_rn(a);
#else
    return std::sqrt(a);
#endif
}

/// Square root, rounded once, of a number from 2^-100 to 2^100. What it is for others differs from
/// device to host: on the device these are the operations that the compiler makes of sqrtf(),
/// without the branch for numbers out of that range.
[[nodiscard]] MIR_HD inline float usual_sqrt(float a) {
#if defined(__CUDA_ARCH__)
    const float estimate = loose::inverse_root(a);
    const float root = __fmul_rn(a, estimate);
    return __fmaf_rn(__fmaf_rn(-root, root, a), __fmul_rn(0.5f, estimate), root);
#else
    return sqrtf(a);
#endif
}

/// 1 / a, rounded once, of a number from 2^-110 to 2^110 in size. See usual_sqrt().
[[nodiscard]] MIR_HD inline float usual_reciprocal(float a) {
#if defined(__CUDA_ARCH__)
    const float estimate = loose::rough_reciprocal(a);
    return __fmaf_rn(estimate, __fmaf_rn(-a, estimate, 1.0f), estimate);
#else
    return 1.0f / a;
#endif
}

/// The smaller of a and `limit`, which is a number: `limit` where `a` is none.
[[nodiscard]] MIR_HD inline float at_most(float a, float limit) {
#if defined(__CUDA_ARCH__)
    return fminf(a, limit);
#else
    return a < limit ? a : limit;
#endif
}

}  // namespace mir::strict
