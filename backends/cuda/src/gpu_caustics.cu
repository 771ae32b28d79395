// SPDX-License-Identifier: MIT
#include "mir/cuda/backend.cuh"
#include "runtime/backend_frame/caustics.hpp"

// The members that are defined by what was included.
template class mir::BackendFrame<mir::cuda::Backend, mir::MIR_BSDF>;
