// SPDX-License-Identifier: MIT
#pragma once

// Members of BackendFrame that find what camera rays see, and what needs no more than that.

#include "mir/resident/trace_primary_hits.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/sampling/visible_area.hpp"
#include "runtime/backend_frame/structures.hpp"

#include <numeric>

namespace mir {

template <Backend M, Bsdf B>
double BackendFrame<M, B>::visible_area() {
    auto areas = machine_.template buffer<double>(AreaRays::count);
    std::vector<double> here(AreaRays::count);
    const WaitAtEnd wait(queue_);
    with_rays([&](const auto& rays) {
        queue_.for_each(AreaRays::count,
                        AreaPass{AreaRays(job_.rays.camera, job_.aspect()),
                                 LuxelTracer{rays.caster(geometry_there_.view()), surfaces_.view()},
                                 areas.data()});
    });
    queue_.download(areas, std::span(here));
    queue_.record().sync();
    return std::accumulate(here.begin(), here.end(), 0.0);
}

template <Backend M, Bsdf B>
BandPtr BackendFrame<M, B>::trace(Extent extent, Extent tile, std::uint32_t first_row) {
    return traced(extent, tile, first_row, job_.rays.luxel_rays());
}

template <Backend M, Bsdf B>
BandPtr BackendFrame<M, B>::trace(const ProbeRays& probes) {
    return traced(probes.cells(), whole_blocks(probes.cells()), 0, probes);
}

template <Backend M, Bsdf B>
template <class Rays>
BandPtr BackendFrame<M, B>::traced(Extent extent, Extent tile, std::uint32_t first_row,
                                   const Rays& camera) {
    auto band = std::make_unique<Band>(BackendGBuffer<M, Params>(machine_, extent, tile));
    band->first_row = first_row;
    with_rays([&](const auto& structure) {
        trace_primary_hits(queue_, band->gbuffer, first_row, camera,
                           LuxelTracer{structure.caster(geometry_there_.view()), surfaces_.view()},
                           lights_.view().environment);
    });
    queue_.record().sync();
    return band;
}

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::black(const FrameBand& band) {
    BackendLayer<M> layer = layer_for(of(band));
    queue_.clear(layer.words());
    queue_.record().sync();
    return std::make_unique<Layer>(std::move(layer));
}

template <Backend M, Bsdf B>
template <class MakePass>
LayerPtr BackendFrame<M, B>::layer_by(const FrameBand& band, const MakePass& pass) {
    const auto& gbuffer = of(band).gbuffer;
    BackendLayer<M> layer = layer_for(of(band));
    const WaitAtEnd wait(queue_);
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
        const auto view = gbuffer.view(t);
        queue_.for_each(view.size(), pass(view, layer.tile(t)));
    }
    queue_.record().sync();
    return std::make_unique<Layer>(std::move(layer));
}

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::emission(const FrameBand& band) {
    return layer_by(band, [](auto luxels, auto out) { return EmissionPass{luxels, out}; });
}

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::coverage(const FrameBand& band) {
    return layer_by(band, [](auto luxels, auto out) { return CoveragePass{luxels, out}; });
}

}  // namespace mir
