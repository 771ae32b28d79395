// SPDX-License-Identifier: MIT
#include "gpu_gather.hpp"
#include "mir/cuda/backend.cuh"

namespace mir::cuda {

template <Bsdf F>
Image<Rgb> GpuGather<F>::operator()(const Luxels& luxels, const SurfelTree& tree,
                                    std::span<const SurfelRadiance> radiance,
                                    const GatherOptions& options, const LuxelBand& band) const {
    if (!there_) there_ = std::make_unique<BackendGather<Backend, F>>(backend_, tree);
    return (*there_)(luxels, radiance, options, band);
}

template class GpuGather<Lambert>;
template class GpuGather<CookTorrance>;

}  // namespace mir::cuda
