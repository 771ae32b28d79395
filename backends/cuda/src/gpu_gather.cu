// SPDX-License-Identifier: MIT
#include "gpu_gather.hpp"
#include "mir/cuda/backend.cuh"

namespace mir::cuda {

template <Bsdf F>
template <class Options>
Image<Rgb> GpuGather<F>::operator()(const Luxels& luxels, const SurfelTree& tree,
                                    std::span<const SurfelRadiance> radiance,
                                    const Options& options, const LuxelBand& band,
                                    const GatherProgress& done) const {
    if (!there_) there_ = std::make_unique<BackendGather<Backend, F>>(backend_, tree);
    return (*there_)(luxels, radiance, options, band, done);
}

template <Bsdf F>
using LuxelsOf = typename GpuGather<F>::Luxels;
using Radiance = std::span<const SurfelRadiance>;

template Image<Rgb> GpuGather<Lambert>::operator()(const LuxelsOf<Lambert>&, const SurfelTree&,
                                                   Radiance, const GatherOptions&, const LuxelBand&,
                                                   const GatherProgress&) const;
template Image<Rgb> GpuGather<Lambert>::operator()(const LuxelsOf<Lambert>&, const SurfelTree&,
                                                   Radiance, const BufferGatherOptions&,
                                                   const LuxelBand&, const GatherProgress&) const;
template Image<Rgb> GpuGather<CookTorrance>::operator()(const LuxelsOf<CookTorrance>&,
                                                        const SurfelTree&, Radiance,
                                                        const GatherOptions&, const LuxelBand&,
                                                        const GatherProgress&) const;
template Image<Rgb> GpuGather<CookTorrance>::operator()(const LuxelsOf<CookTorrance>&,
                                                        const SurfelTree&, Radiance,
                                                        const BufferGatherOptions&,
                                                        const LuxelBand&,
                                                        const GatherProgress&) const;

}  // namespace mir::cuda
