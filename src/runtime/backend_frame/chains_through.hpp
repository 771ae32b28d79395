// SPDX-License-Identifier: MIT
#pragma once

// The kernels of Markov chains of BackendFrame, which nvcc takes longest for: a file for each kind
// of rays.

#include "mir/resident/backend_metropolis.hpp"
#include "mir/resident/ray_structures.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "runtime/backend_frame.hpp"

namespace mir {

template <Backend M, Bsdf B>
template <class Rays>
VplRecords BackendFrame<M, B>::sample_chains_through(const Rays& rays,
                                                     const MetropolisOptions& options,
                                                     float bound) {
    const WaitAtEnd wait(queue_);
    ChainPortions portions;
    portions.bytes = options_.chain_bytes;
    const PathWorld<B, typename Rays::Caster, typename Rays::Sight, space> world(
        geometry_there_.view(), lights_.view(), surfaces_.view(),
        rays.caster(geometry_there_.view()), rays.sight(), job_.rays.camera.optics(), job_.aspect(),
        bound);
    return BackendMetropolis(machine_, world, options, job_.settings.limits, portions)
        .sample(queue_, job_.monitor);
}

}  // namespace mir
