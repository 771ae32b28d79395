// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "support/copied_wide_bvh.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in wide_bvh.cu.

namespace mirtest {

/// build_wide_on() the GPU.
CopiedWideBvh build_wide_on_gpu(const mir::cuda::Backend& backend,
                                const mir::WorldGeometry& geometry,
                                const mir::WideBvhOptions& options = {});

}  // namespace mirtest
