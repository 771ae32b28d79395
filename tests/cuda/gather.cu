// SPDX-License-Identifier: MIT
#include "cuda/gather.hpp"
#include "mir/cuda/backend.cuh"

namespace mirtest {
namespace {

using Gather = mir::BackendGather<mir::cuda::Backend, mir::Lambert>;

}  // namespace

mir::Image<mir::Rgb> gather_on_gpu(const mir::cuda::Backend& backend, const GatherInput& in,
                                   const mir::GatherOptions& options) {
    return Gather(backend, in.tree)(in.luxels, in.radiance, options, in.band);
}

mir::Image<mir::Rgb> gather_on_gpu(const mir::cuda::Backend& backend, const GatherInput& in,
                                   const mir::BufferGatherOptions& options) {
    return Gather(backend, in.tree)(in.luxels, in.radiance, options, in.band);
}

}  // namespace mirtest
