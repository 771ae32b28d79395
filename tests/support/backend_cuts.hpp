// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/resident/backend_cuts.hpp"
#include "mir/shading/vpl_shading.hpp"

#include <vector>

namespace mirtest {

/// What a BackendCuts is asked. A view. nvcc compiles this, but no builder of kd-trees.
template <mir::Bsdf B>
struct CutsAsked {
    const mir::BlockedGBuffer<typename B::Params>& luxels;
    mir::VplSpan<mir::Space::host> vpls;
    mir::VplShading<B> shading;
    std::uint32_t picks;
    mir::CutPlace place;
    mir::Monitor* monitor;
};

/// The light that a backend gathers, at home. `visibility` is that of the scene in its memory; cuts
/// have `bytes` there.
template <mir::Backend M, mir::Bsdf B, mir::Visibility V>
mir::Image<mir::Rgb> cuts_on(const M& backend, const CutsAsked<B>& asked, const V& visibility,
                             std::uint64_t bytes = mir::BackendCuts<M>::default_bytes) {
    typename M::Queue queue = backend.queue();
    const mir::Tile& first = asked.luxels.tiles().front();
    mir::BackendGBuffer<M, typename B::Params> there(backend, asked.luxels.extent(),
                                                     {first.width, first.height});
    there.upload(queue, asked.luxels);
    queue.record().sync();
    mir::BackendCuts<M> cuts(backend, asked.vpls, mir::DeviationCut{asked.picks}, bytes);
    auto layer = cuts.gather(there, visibility, asked.shading, asked.place, asked.monitor);
    std::vector<std::uint32_t> words(layer.words().size());
    queue.download(layer.words(), std::span(words));
    queue.record().sync();
    const mir::LayerView view{words.data(), layer.grid()};
    mir::Image<mir::Rgb> image(view.grid.image);
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) image(x, y) = view(x, y);
    return image;
}

}  // namespace mirtest
