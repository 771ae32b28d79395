// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/append_outputs.hpp"
#include "mir/sampling/caustic_tracer.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// Item of append_outputs(): a light path, whose outputs are its splats.
template <class Tracer>
struct CausticOutputs {
    Tracer tracer;            ///< a CausticTracer
    CausticPaths paths;       ///< all of them
    std::uint64_t first = 0;  ///< path of item 0

    /// Calls out.add(splat) for each splat of path first + i.
    template <class Out>
    MIR_HD void operator()(std::uint32_t i, Out& out) const {
        tracer(first + i, paths, out);
    }
};

/// trace_caustics() on a backend, with its bits where neither compiler fuses products
/// (docs/embedding.md). What the tracer views lies there. All work is done when it returns.
/// @throws What the backend throws.
template <Backend M, Bsdf B, class R, Visibility V>
[[nodiscard]] std::vector<CausticSplat> trace_caustics_there(
    const M& backend, typename M::Queue& queue, const CausticTracer<B, R, V>& tracer,
    const CausticPaths& paths, std::uint64_t first, std::uint64_t last) {
    constexpr std::uint64_t at_a_time = std::uint64_t{1} << 20;
    std::vector<CausticSplat> splats;
    for (; first < last; first += at_a_time)
        append_outputs(backend, queue,
                       static_cast<std::uint32_t>(std::min(at_a_time, last - first)),
                       CausticOutputs<CausticTracer<B, R, V>>{tracer, paths, first}, splats);
    return splats;
}

}  // namespace mir
