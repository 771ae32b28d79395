// SPDX-License-Identifier: MIT
#pragma once

// Light of VPLs of BackendFrame, by tracing or from bits that stayed on the backend.

#include "mir/kernels/word_shading.hpp"
#include "mir/resident/uploaded_vpls.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"
#include "runtime/backend_frame/structures.hpp"

namespace mir {

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::light(const FrameBand& band, Vpls vpls, VplKernel kernel,
                                   Monitor* monitor) {
    if (band.knows_visibility()) return light_known(of(band), vpls, kernel, monitor);
    return upload(of(band), light_traced(of(band), vpls, kernel, monitor));
}

/// The second kernel of RCVP alone.
template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::light_known(const Band& band, Vpls vpls, VplKernel kernel,
                                         Monitor* monitor) {
    const auto& gbuffer = band.gbuffer;
    BackendLayer<M> layer = layer_for(band);
    UploadedVpls<M> there(machine_, vpls);
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    with_shading<B>(kernel, [&](const auto& shading) {
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
            if (monitor != nullptr) monitor->check();
            const auto view = gbuffer.view(t);
            queue_.for_each_group(view.size() / LaneGroup::width,
                                  WordShading{view, there.view(), band.visibility->tile(t).words,
                                              shading, layer.tile(t)});
            queue_.record().sync();
            const Tile tile = gbuffer.tiles()[t];
            if (monitor != nullptr)
                monitor->contributions += std::uint64_t{tile.width} * tile.height * vpls.size();
        }
    });
    return std::make_unique<Layer>(std::move(layer));
}

template <Backend M, Bsdf B>
Image<Rgb> BackendFrame<M, B>::light_traced(const Band& band, Vpls vpls, VplKernel kernel,
                                            Monitor* monitor) {
    return with_shading<B>(kernel, [&](const auto& shading) {
        switch (options_.scheduler) {
            case BackendScheduler::os: {
                const Tile& first = band.gbuffer.tiles().front();
                BlockedGBuffer<Params> here(band.extent(), {first.width, first.height});
                band.gbuffer.download(queue_, here);
                queue_.record().sync();
                return reconstruct(sched::ShadingOnly{machine_, job_.threads, monitor}, here, vpls,
                                   rays().visibility(), shading);
            }
            case BackendScheduler::rc:
                return with_rays([&](const auto& rays) {
                    return reconstruct(sched::Reconstruct{machine_, monitor}, band.gbuffer, vpls,
                                       rays.sight(), shading);
                });
            case BackendScheduler::rcvp:
                break;
        }
        return with_tile_visibility([&](const auto& visibility) {
            return reconstruct(sched::ReconstructVisibilityParallel{machine_, monitor},
                               band.gbuffer, vpls, visibility, shading);
        });
    });
}

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::upload(const Band& band, const Image<Rgb>& image) {
    BackendLayer<M> layer = layer_for(band);
    std::vector<std::uint32_t> words(layer.words().size());
    for (TileIndex t = 0; t < band.gbuffer.tiles().size(); ++t) {
        const Tile tile = band.gbuffer.tiles()[t];
        const auto layout = BlockedLayout::of(tile);
        const SoaView<Rgb> to{words.data() + LayerView::first_word(layer.grid(), t), layout.size()};
        job_.threads.for_each(tile.height, [&](std::size_t row) {
            const auto y = static_cast<std::uint32_t>(row);
            for (std::uint32_t x = 0; x < tile.width; ++x)
                to.store(layout(x, y), image(tile.x + x, tile.y + y));
        });
    }
    const WaitAtEnd wait(queue_);
    queue_.upload(std::span<const std::uint32_t>(words), layer.words());
    queue_.record().sync();
    return std::make_unique<Layer>(std::move(layer));
}

}  // namespace mir
