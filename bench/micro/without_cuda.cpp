// SPDX-License-Identifier: MIT
#include "gpu_gathers.hpp"

namespace mirbench {

bool has_cuda() { return false; }

std::unique_ptr<GpuGathers> make_gpu_gathers(const GatherInput&) {
    throw mir::Error(mir::ErrorCode::no_device,
                     "this program was built without CUDA; configure with the preset cuda");
}

}  // namespace mirbench
