// SPDX-License-Identifier: MIT
#pragma once

// Direct light of BackendFrame.

#include "mir/kernels/direct_light_pass.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "runtime/backend_frame/structures.hpp"

namespace mir {

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::direct(const FrameBand& band, DirectSamples samples) {
    const auto& gbuffer = of(band).gbuffer;
    BackendLayer<M> layer = layer_for(of(band));
    const WaitAtEnd wait(queue_);
    with_rays([&](const auto& rays) {
        using Sight = typename std::remove_cvref_t<decltype(rays)>::Sight;
        const LuxelLight<B, Sight> light(lights_.view(), geometry_there_.view(), rays.sight(),
                                         samples,
                                         {band.first_row, job_.rays.grid, job_.settings.seed});
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
            const auto view = gbuffer.view(t);
            queue_.for_each(view.size(),
                            DirectLightPass{view, gbuffer.tiles()[t], light, layer.tile(t)});
        }
    });
    queue_.record().sync();
    return std::make_unique<Layer>(std::move(layer));
}

}  // namespace mir
