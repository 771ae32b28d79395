// SPDX-License-Identifier: MIT
#include "cuda/shafts.hpp"
#include "mir/cuda/backend.cuh"

namespace mirtest {

std::vector<std::uint32_t> shaft_words_on_gpu(const mir::cuda::Backend& backend,
                                              const ShaftInput& in,
                                              const mir::BackendShaftOptions& options) {
    return shaft_words(backend, in, options);
}

}  // namespace mirtest
