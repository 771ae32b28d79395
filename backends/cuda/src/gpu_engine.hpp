// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cpu/tbb_executor.hpp"
#include "mir/cuda/backend.hpp"
#include "mir/runtime/backend_engine.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"

namespace mir::cuda {

/// A scene on a GPU, whose kernels are compiled for the models of Bsdf and Shading that renderers
/// use (gpu_engine.cu).
template <Bsdf F>
using GpuEngine = BackendEngine<Backend, F, cpu::TbbExecutor>;

static_assert(BandEngine<GpuEngine<Lambert>> && SamplingEngine<GpuEngine<Lambert>>);

}  // namespace mir::cuda
