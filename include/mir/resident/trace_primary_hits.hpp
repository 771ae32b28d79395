// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/primary_hits.hpp"
#include "mir/resident/backend_gbuffer.hpp"

namespace mir {

/// First phase on a backend. Traces the camera ray of every luxel of `gbuffer`, which holds the
/// rows from `first_row` on of the luxel image. What fill_gbuffer() does on the host, bit for bit
/// where rays and tracer give the same bits. Starts the work on `queue`; others wait for an event
/// of it.
template <Backend B, Bsdf F, class Rays, class R>
void trace_primary_hits(typename B::Queue& queue, BackendGBuffer<B, typename F::Params>& gbuffer,
                        std::uint32_t first_row, const Rays& rays,
                        const LuxelTracer<R, B::space, F>& tracer,
                        const EnvironmentView<B::space>& background) {
    queue.for_each(static_cast<std::uint32_t>(gbuffer.grid().size()),
                   PrimaryHits{rays, tracer, background, gbuffer.words(), first_row});
}

}  // namespace mir
