// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "support/shaft_words.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in shafts.cu.

namespace mirtest {

/// shaft_words() of the GPU.
std::vector<std::uint32_t> shaft_words_on_gpu(const mir::cuda::Backend& backend,
                                              const ShaftInput& in,
                                              const mir::BackendShaftOptions& options);

}  // namespace mirtest
