// SPDX-License-Identifier: MIT
#pragma once

// Markov chains of BackendFrame.

#include "mir/resident/backend_metropolis.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "runtime/backend_frame/structures.hpp"

namespace mir {

template <Backend M, Bsdf B>
VplRecords BackendFrame<M, B>::sample_chains(const MetropolisOptions& options, float bound) {
    const UploadedLights<M> there(machine_, queue_, job_.lights);
    const WaitAtEnd wait(queue_);
    ChainPortions portions;
    portions.bytes = options_.chain_bytes;
    return with_rays([&](const auto& rays) {
        using Rays = std::remove_cvref_t<decltype(rays)>;
        const PathWorld<B, typename Rays::Caster, typename Rays::Sight, space> world(
            geometry_there_.view(), there.view(), surfaces_.view(),
            rays.caster(geometry_there_.view()), rays.sight(), job_.rays.camera.optics(),
            job_.aspect(), bound);
        return BackendMetropolis(machine_, world, options, job_.settings.limits, portions)
            .sample(queue_, job_.monitor);
    });
}

}  // namespace mir
