// SPDX-License-Identifier: MIT
#pragma once

// Light of many VPLs of BackendFrame, by cuts of their tree.

#include "mir/resident/backend_cuts.hpp"
#include "runtime/backend_frame/structures.hpp"

namespace mir {

template <Backend M, Bsdf B>
LayerPtr BackendFrame<M, B>::light_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                           Monitor* monitor) {
    if (!cut_vpls_ || !cut_vpls_->is(vpls)) {
        cuts_.reset();  // its memory first
        cuts_ = std::make_shared<BackendCuts<M>>(machine_, vpls.vpls(),
                                                 DeviationCut{job_.settings.picks});
        cut_vpls_ = vpls;
    }
    return with_rays([&](const auto& rays) -> LayerPtr {
        return std::make_unique<Layer>(
            cuts_->gather(of(band).gbuffer, rays.sight(), VplShading<B>{bound},
                          {job_.settings.seed, band.first_row}, monitor));
    });
}

}  // namespace mir
