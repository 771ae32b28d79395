// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "mir/resident/backend_gather.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in gather.cu.

namespace mirtest {

/// What a BackendGather is asked. A view.
struct GatherInput {
    const mir::SurfelTree& tree;
    std::span<const mir::SurfelRadiance> radiance;
    const mir::BlockedGBuffer<mir::Lambert::Params>& luxels;
    mir::LuxelBand band;
};

/// BackendGather on the GPU.
mir::Image<mir::Rgb> gather_on_gpu(const mir::cuda::Backend& backend, const GatherInput& in,
                                   const mir::GatherOptions& options);
mir::Image<mir::Rgb> gather_on_gpu(const mir::cuda::Backend& backend, const GatherInput& in,
                                   const mir::BufferGatherOptions& options);

}  // namespace mirtest
