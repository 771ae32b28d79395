// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/primary_hits.hpp"
#include "mir/resident/backend_gbuffer.hpp"

namespace mir {

/// First phase on a backend: traces the camera ray of every luxel of `gbuffer`, which holds the
/// rows from `first_row` on of the luxel image. What fill_gbuffer() does on the host, bit for bit
/// where rays and finder give the same bits. Starts the work on `queue`; others wait for an event
/// of it.
template <Backend B, Bsdf F, class Rays, RayFinder Finder>
    requires AccessibleFrom<Finder, B::space>
void trace_primary_hits(typename B::Queue& queue, BackendGBuffer<B, typename F::Params>& gbuffer,
                        std::uint32_t first_row, const Rays& rays, const Finder& finder,
                        GeometryView<B::space> geometry, SurfaceTableView<B::space, F> surfaces) {
    queue.for_each(static_cast<std::uint32_t>(gbuffer.grid().size()),
                   PrimaryHits{rays, finder, geometry, surfaces, gbuffer.words(), first_row});
}

}  // namespace mir
