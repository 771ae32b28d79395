// SPDX-License-Identifier: MIT
#pragma once

// Markov chains of BackendFrame: by what rays go through is chosen here, the kernels are those of
// runtime/backend_frame/chains_through.hpp.

#include "runtime/backend_frame/structures.hpp"

namespace mir {

template <Backend M, Bsdf B>
VplRecords BackendFrame<M, B>::sample_chains(const MetropolisOptions& options, float bound) {
    return with_rays([&](const auto& rays) { return sample_chains_through(rays, options, bound); });
}

}  // namespace mir
