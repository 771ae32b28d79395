// SPDX-License-Identifier: MIT
#pragma once

/// Marks a function that kernels call: compiled for host and device under nvcc, plain elsewhere.
/// The only macro that public headers leave behind.
#if defined(__CUDACC__)
#define MIR_HD __host__ __device__
#else
#define MIR_HD
#endif
