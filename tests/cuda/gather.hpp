// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "mir/resident/backend_gather.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in gather.cu.

namespace mirtest {

/// What a BackendGather is asked. A view.
template <mir::Bsdf B>
struct GatherInput {
    const mir::SurfelTree& tree;
    std::span<const mir::SurfelRadiance> radiance;
    const mir::BlockedGBuffer<typename B::Params>& luxels;
    mir::LuxelBand band;
};

/// BackendGather on the GPU, by GatherOptions or BufferGatherOptions.
template <mir::Bsdf B, class Options>
mir::Image<mir::Rgb> gather_on_gpu(const mir::cuda::Backend& backend, const GatherInput<B>& in,
                                   const Options& options);

}  // namespace mirtest
