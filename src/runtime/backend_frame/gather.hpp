// SPDX-License-Identifier: MIT
#pragma once

// The member of BackendDiscGather that starts kernels.

#include "runtime/backend_disc_gather.hpp"

namespace mir {

template <Backend M, Bsdf B>
Image<Rgb> BackendDiscGather<M, B>::gather(const AnyLuxels& luxels, const SurfelTree& tree,
                                           std::span<const SurfelRadiance> radiance,
                                           const DiscGatherOptions& options, const LuxelBand& band,
                                           const Done& done) {
    if (!there_) there_ = std::make_unique<BackendGather<M, B>>(machine_, tree);
    return std::visit(
        [&](const auto& by) {
            return (*there_)(std::get<LuxelsOf<B>>(luxels).gbuffer, radiance, by, band, done);
        },
        options);
}

}  // namespace mir
