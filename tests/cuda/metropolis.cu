// SPDX-License-Identifier: MIT
#include "cuda/metropolis.hpp"
#include "mir/cuda/backend.cuh"

namespace mirtest {

template <mir::Bsdf F>
mir::VplRecords chains_on_gpu(const mir::cuda::Backend& backend, const ChainParts<F>& parts,
                              const mir::MetropolisOptions& options, std::uint64_t bytes) {
    return chains_on(backend, parts, options, bytes);
}

template mir::VplRecords chains_on_gpu(const mir::cuda::Backend&, const ChainParts<mir::Lambert>&,
                                       const mir::MetropolisOptions&, std::uint64_t);
template mir::VplRecords chains_on_gpu(const mir::cuda::Backend&,
                                       const ChainParts<mir::CookTorrance>&,
                                       const mir::MetropolisOptions&, std::uint64_t);

}  // namespace mirtest
