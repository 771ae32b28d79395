// SPDX-License-Identifier: MIT
#include "runtime/traced_scene.hpp"

#include "mir/fill_visibility.hpp"
#include "mir/reconstruct.hpp"
#include "mir/shading/vpl_shading.hpp"

namespace mir {

void TracedScene::fill_visibility(VisibilityMatrix& matrix, const AnyLuxels& luxels,
                                  VplSpan<Space::host> vpls, AnyExecutor& executor) const {
    std::visit(
        [&](const auto& of) {
            if (rays_.answers_blocks())
                mir::fill_visibility(matrix, of.gbuffer, vpls, rays_.block_visibility(), executor);
            else
                mir::fill_visibility(matrix, of.gbuffer, vpls, rays_.visibility(), executor);
        },
        luxels);
}

Image<Rgb> TracedScene::reconstruct(const sched::CpuBlocks<AnyExecutor>& scheduler,
                                    const AnyLuxels& luxels, VplSpan<Space::host> vpls,
                                    VplKernel kernel) const {
    return std::visit(
        [&]<Bsdf B>(const LuxelsOf<B>& of) {
            // Few VPLs reach a block with what is removed of them: no block is worth preparing.
            if (kernel.kind == VplKernel::Kind::removed)
                return mir::reconstruct(scheduler, of.gbuffer, vpls, rays_.visibility(),
                                        RemovedByBound<B>{kernel.bound});
            const VplShading<B> shading{kernel.bound};
            if (rays_.answers_blocks())
                return mir::reconstruct(scheduler, of.gbuffer, vpls, rays_.block_visibility(),
                                        shading);
            return mir::reconstruct(scheduler, of.gbuffer, vpls, rays_.visibility(), shading);
        },
        luxels);
}

}  // namespace mir
