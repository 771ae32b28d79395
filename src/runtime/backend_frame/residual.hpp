// SPDX-License-Identifier: MIT
#pragma once

// Light of BackendFrame that paths trace back.

#include "mir/resident/uploaded_scene.hpp"
#include "runtime/backend_frame/structures.hpp"
#include "runtime/residual_light.hpp"

namespace mir {

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::residual(const FrameBand& band, float bound,
                                      std::span<const LayerPtr> bounces) {
    const auto& gbuffer = of(band).gbuffer;
    BackendLayer<M> sum = layer_for(of(band));
    std::vector<std::uint32_t*> layers;
    for (const LayerPtr& layer : bounces) layers.push_back(of(*layer).words().data());
    const LuxelBand place{band.first_row, job_.rays.grid, job_.settings.seed};
    const UploadedArray<M, std::uint32_t*> there(machine_, queue_, std::span(layers));
    const WaitAtEnd wait(queue_);
    with_rays([&](const auto& rays) {
        using Rays = std::remove_cvref_t<decltype(rays)>;
        using Light = ResidualLight<B, typename Rays::Caster, typename Rays::Sight>;
        const Light light({geometry_there_.view(), lights_.view(), surfaces_.view(),
                           rays.caster(geometry_there_.view()), rays.sight()},
                          job_.settings, bound, place);
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
            const auto view = gbuffer.view(t);
            queue_.for_each(view.size(), ResidualPass<decltype(view), Light>{
                                             view, gbuffer.tiles()[t], light, sum.tile(t),
                                             LayerView::first_word(sum.grid(), t), there.data(),
                                             static_cast<std::uint32_t>(layers.size())});
        }
    });
    queue_.record().sync();
    return std::make_unique<Layer>(std::move(sum));
}

}  // namespace mir
