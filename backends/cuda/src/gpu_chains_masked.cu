// SPDX-License-Identifier: MIT
#include "mir/cuda/backend.cuh"
#include "runtime/backend_frame/chains_through.hpp"

namespace mir {

template VplRecords BackendFrame<cuda::Backend, MIR_BSDF>::sample_chains_through(
    const WideRays<Space::device, OpacityView<Space::device>>&, const MetropolisOptions&, float);

}  // namespace mir
