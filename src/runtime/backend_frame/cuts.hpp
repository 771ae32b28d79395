// SPDX-License-Identifier: MIT
#pragma once

// Light of many VPLs of BackendFrame, by cuts of their tree.

#include "mir/resident/backend_cuts.hpp"
#include "runtime/backend_frame/structures.hpp"

#include <algorithm>

namespace mir {

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::light_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                           Monitor* monitor) {
    auto kept = std::find_if(cuts_.begin(), cuts_.end(),
                             [&](const auto& cuts) { return cuts.first.is(vpls); });
    if (kept == cuts_.end())
        kept = cuts_.emplace(kept, vpls,
                             std::make_shared<BackendCuts<M>>(machine_, vpls.vpls(),
                                                              DeviationCut{job_.settings.picks}));
    return with_rays([&](const auto& rays) -> LayerPtr {
        return std::make_unique<Layer>(
            kept->second->gather(of(band).gbuffer, rays.sight(), VplShading<B>{bound},
                                 {job_.settings.seed, band.first_row}, monitor));
    });
}

}  // namespace mir
