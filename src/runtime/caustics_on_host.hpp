// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

#include <span>
#include <vector>

namespace mir {

/// RenderFrame::trace_caustics() on the frame's executor, by rays of the host.
[[nodiscard]] std::vector<CausticSplat> trace_caustics_on_host(RenderFrame& frame,
                                                               const CausticPaths& paths,
                                                               std::uint64_t begin,
                                                               std::uint64_t end);

/// Caustics of the luxels of a band, W m^-2 sr^-1.
struct CausticImages {
    Image<Rgb> direct;    ///< light of one bounce
    Image<Rgb> indirect;  ///< that of more
};

/// RenderFrame::seen_caustics() on the frame's executor, by rays of the host. That of bounce b > 1
/// is added to element b - 1 of `bounces` too, or to the last one.
[[nodiscard]] CausticImages seen_caustics_on_host(RenderFrame& frame, const FrameBand& band,
                                                  std::span<Image<Rgb>* const> bounces);

}  // namespace mir
