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
                                    float bound) const {
    return std::visit(
        [&]<Bsdf B>(const LuxelsOf<B>& of) {
            const VplShading<B> shading{bound};
            return rays_.answers_blocks()
                       ? mir::reconstruct(scheduler, of.gbuffer, vpls, rays_.block_visibility(),
                                          shading)
                       : mir::reconstruct(scheduler, of.gbuffer, vpls, rays_.visibility(), shading);
        },
        luxels);
}

Image<Rgb> TracedScene::removed(const sched::CpuBlocks<AnyExecutor>& scheduler,
                                const AnyLuxels& luxels, VplSpan<Space::host> vpls,
                                float bound) const {
    return std::visit(
        [&]<Bsdf B>(const LuxelsOf<B>& of) {
            return mir::reconstruct(scheduler, of.gbuffer, vpls, rays_.visibility(),
                                    RemovedByBound<B>{bound});
        },
        luxels);
}

}  // namespace mir
