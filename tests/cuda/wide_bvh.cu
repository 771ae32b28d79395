// SPDX-License-Identifier: MIT
#include "cuda/wide_bvh.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/cuda/sort.cuh"

namespace mirtest {

CopiedWideBvh build_wide_on_gpu(const mir::cuda::Backend& backend,
                                const mir::WorldGeometry& geometry,
                                const mir::WideBvhOptions& options) {
    return build_wide_on(backend, geometry, options);
}

}  // namespace mirtest
