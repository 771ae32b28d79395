// SPDX-License-Identifier: MIT
#include "mir/cuda/backend.cuh"
#include "runtime/backend_frame/gather.hpp"

template class mir::BackendDiscGather<mir::cuda::Backend, mir::MIR_BSDF>;
