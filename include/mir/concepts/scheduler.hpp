// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <concepts>

namespace mir {

/// What a scheduler opens for one image. Owns queues and buffers and dies with the call.
template <class P>
concept Pipeline = requires(P p, TileIndex t) {
    p.submit(t);  // may return before the tile is done
    p.finish();   // every submitted luxel is written, once
};

/// An arrangement in time of the paper's section 5, as a value that opens pipelines. `Inputs` is
/// mir::Inputs<...> of reconstruct.hpp.
///
/// Axioms (validation/scheduler.hpp): each luxel of each submitted tile is written
/// exactly once; the order of tiles does not change the image; no VPLs give black; the image is
/// that of sched::Cpu.
template <class S, class Inputs>
concept Scheduler = requires(const S s, const Inputs& in, Image<Rgb>& out) {
    { s.open(in, out) } -> Pipeline;
};

}  // namespace mir
