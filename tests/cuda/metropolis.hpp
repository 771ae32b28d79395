// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/backend_chains.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in metropolis.cu.

namespace mirtest {

/// chains_on() the GPU.
template <mir::Bsdf F>
mir::VplRecords chains_on_gpu(const mir::cuda::Backend& backend, const ChainParts<F>& parts,
                              const mir::MetropolisOptions& options,
                              const mir::ChainPortions& portions);

}  // namespace mirtest
