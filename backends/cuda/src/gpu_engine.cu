// SPDX-License-Identifier: MIT
#include "gpu_engine.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/cuda/sort.cuh"
#include "mir/runtime/backend_engine_kernels.hpp"

namespace mir {

using cpu::TbbExecutor;

template class BackendEngine<cuda::Backend, Lambert, TbbExecutor>;
template class BackendEngine<cuda::Backend, CookTorrance, TbbExecutor>;

template auto cuda::GpuEngine<Lambert>::light(const Luxels&, VplSpan<Space::host>,
                                              const VplShading<Lambert>&, Monitor*) const -> Layer;
template auto cuda::GpuEngine<Lambert>::light(const Luxels&, VplSpan<Space::host>,
                                              const RemovedByBound<Lambert>&, Monitor*) const
    -> Layer;
template auto cuda::GpuEngine<CookTorrance>::light(const Luxels&, VplSpan<Space::host>,
                                                   const VplShading<CookTorrance>&, Monitor*) const
    -> Layer;
template auto cuda::GpuEngine<CookTorrance>::light(const Luxels&, VplSpan<Space::host>,
                                                   const RemovedByBound<CookTorrance>&,
                                                   Monitor*) const -> Layer;

}  // namespace mir
