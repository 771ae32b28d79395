// SPDX-License-Identifier: MIT
#pragma once

// Caustics of BackendFrame: splats of light paths, and what luxels see in mirrors and glass.

#include "mir/resident/backend_caustics.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "runtime/backend_frame/structures.hpp"
#include "runtime/caustic_light.hpp"
#include "runtime/seen_caustics.hpp"

namespace mir {

template <Backend M, Bsdf B>
std::vector<CausticSplat> BackendFrame<M, B>::trace_caustics(const CausticPaths& paths,
                                                             std::uint64_t begin,
                                                             std::uint64_t end) {
    return with_rays([&](const auto& rays) {
        using Rays = std::remove_cvref_t<decltype(rays)>;
        const LightWalk<B, typename Rays::Caster, space> walk{surfaces_.view(),
                                                              rays.caster(geometry_there_.view())};
        const CausticTracer<B, typename Rays::Caster, typename Rays::Sight> tracer(
            lights_.view(), geometry_there_.view(), walk, rays.sight(), caustic_view(job_));
        return trace_caustics_there(machine_, queue_, tracer, paths, begin, end);
    });
}

template <Backend M, Bsdf B>
CausticLayers BackendFrame<M, B>::seen_caustics(const FrameBand& band,
                                                std::span<const LayerPtr> bounces) {
    const auto& gbuffer = of(band).gbuffer;
    BackendLayer<M> direct = layer_for(of(band));
    BackendLayer<M> indirect = layer_for(of(band));
    std::vector<std::uint32_t*> layers;
    for (const LayerPtr& layer : bounces) layers.push_back(of(*layer).words().data());
    const UploadedArray<M, std::uint32_t*> there(machine_, queue_, std::span(layers));
    const WaitAtEnd wait(queue_);
    with_rays([&](const auto& rays) {
        using Rays = std::remove_cvref_t<decltype(rays)>;
        using Caustics = SeenCaustics<B, typename Rays::Caster, typename Rays::Sight>;
        const Caustics caustics({geometry_there_.view(), lights_.view(), surfaces_.view(),
                                 rays.caster(geometry_there_.view()), rays.sight()},
                                job_.settings, job_.rays.luxel_rays());
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t)
            queue_.for_each(gbuffer.view(t).size(),
                            SeenCausticsPass<Caustics>{
                                gbuffer.tiles()[t], band.first_row, caustics, direct.tile(t),
                                indirect.tile(t), LayerView::first_word(direct.grid(), t),
                                there.data(), static_cast<std::uint32_t>(layers.size())});
    });
    queue_.record().sync();
    return {std::make_unique<Layer>(std::move(direct)),
            std::make_unique<Layer>(std::move(indirect))};
}

}  // namespace mir
