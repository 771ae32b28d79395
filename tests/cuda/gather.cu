// SPDX-License-Identifier: MIT
#include "cuda/gather.hpp"
#include "mir/cuda/backend.cuh"

namespace mirtest {

template <mir::Bsdf B, class Options>
mir::Image<mir::Rgb> gather_on_gpu(const mir::cuda::Backend& backend, const GatherInput<B>& in,
                                   const Options& options) {
    return mir::BackendGather<mir::cuda::Backend, B>(backend, in.tree)(in.luxels, in.radiance,
                                                                       options, in.band);
}

using Picture = mir::Image<mir::Rgb>;
using mir::cuda::Backend;

template Picture gather_on_gpu(const Backend&, const GatherInput<mir::Lambert>&,
                               const mir::GatherOptions&);
template Picture gather_on_gpu(const Backend&, const GatherInput<mir::Lambert>&,
                               const mir::BufferGatherOptions&);
template Picture gather_on_gpu(const Backend&, const GatherInput<mir::CookTorrance>&,
                               const mir::GatherOptions&);
template Picture gather_on_gpu(const Backend&, const GatherInput<mir::CookTorrance>&,
                               const mir::BufferGatherOptions&);

}  // namespace mirtest
