// SPDX-License-Identifier: MIT
#pragma once

// The CUDA backend for files that nvcc compiles: with it schedulers can start kernels.
#include "mir/cuda/backend.hpp"
#include "mir/cuda/launch.cuh"
