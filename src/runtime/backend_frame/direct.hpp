// SPDX-License-Identifier: MIT
#pragma once

// Direct light of BackendFrame.

#include "mir/kernels/direct_light_pass.hpp"
#include "mir/resident/backend_skies.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "runtime/backend_frame/structures.hpp"

#include <optional>

namespace mir {

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::direct(const FrameBand& band, DirectSamples samples) {
    const auto& gbuffer = of(band).gbuffer;
    BackendLayer<M> layer = layer_for(of(band));
    std::optional<BackendSkies<M>> skies;
    if (samples.want_sky_guide() && !job_.lights.environment().empty())
        skies.emplace(machine_, gbuffer.tiles());
    const LuxelBand place{band.first_row, job_.rays.grid, job_.settings.seed};
    const WaitAtEnd wait(queue_);
    with_rays([&](const auto& rays) {
        using Sight = typename std::remove_cvref_t<decltype(rays)>::Sight;
        const LuxelLight<B, Sight> light(lights_.view(), geometry_there_.view(), rays.sight(),
                                         samples, place);
        const SkyTries<Sight> tries(lights_.view(), rays.sight());
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
            const auto view = gbuffer.view(t);
            const Tile tile = gbuffer.tiles()[t];
            const SkyGuide* const sky =
                skies ? skies->find(queue_, view, tile, place, tries) : nullptr;
            queue_.for_each(view.size(), DirectLightPass{view, tile, light, layer.tile(t), sky});
        }
    });
    queue_.record().sync();
    return std::make_unique<Layer>(std::move(layer));
}

}  // namespace mir
