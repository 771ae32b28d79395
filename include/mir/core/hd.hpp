// SPDX-License-Identifier: MIT
#pragma once

/// Marks a function that kernels call: compiled for host and device under nvcc, plain elsewhere.
/// It and MIR_HD_CALL are the only macros that public headers leave behind.
#if defined(__CUDACC__)
#define MIR_HD __host__ __device__
#else
#define MIR_HD
#endif

/// Marks a MIR_HD function that kernels hold once and call. Without it a device compiler copies
/// all that a light path goes through, trees included, to each of its many callers.
#if defined(__CUDACC__)
#define MIR_HD_CALL __host__ __device__ __noinline__
#else
#define MIR_HD_CALL
#endif

// Values that are no numbers would pass every check, infinities that end a search would not, and
// what is exact by the order of its operations, such as shafts and edges without gaps, would leak.
#if (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(__ASSOCIATIVE_MATH__)
#error "mir needs the arithmetic of IEEE 754: compile files that include it with -fno-fast-math"
#endif
