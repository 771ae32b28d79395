// SPDX-License-Identifier: MIT
#include "cuda/metropolis.hpp"
#include "mir/cuda/backend.cuh"

namespace mirtest {

template <mir::Bsdf F>
mir::VplRecords chains_on_gpu(const mir::cuda::Backend& backend, const ChainParts<F>& parts,
                              const mir::MetropolisOptions& options,
                              const mir::ChainPortions& portions) {
    return chains_on(backend, parts, options, portions);
}

template mir::VplRecords chains_on_gpu(const mir::cuda::Backend&, const ChainParts<mir::Lambert>&,
                                       const mir::MetropolisOptions&, const mir::ChainPortions&);
template mir::VplRecords chains_on_gpu(const mir::cuda::Backend&,
                                       const ChainParts<mir::CookTorrance>&,
                                       const mir::MetropolisOptions&, const mir::ChainPortions&);

}  // namespace mirtest
