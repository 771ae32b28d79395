// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/caustic_tracer.hpp"
#include "runtime/render_frame.hpp"

#include <vector>

namespace mir {

/// Light that mirrors and glass throw on the surfaces of a render, by light paths of the host.
class CausticLight {
 public:
    /// Traces the paths, where the settings want them and the scene bends rays.
    /// @throws Error(cancelled)
    explicit CausticLight(RenderFrame& frame);

    /// Adds it to a band's layers (FilmLayer): what lamps send to direct light, the rest to
    /// indirect light and to the bounces where there are any.
    void add(RenderFrame& by, const FrameBand& band, std::vector<LayerPtr>& layers) const;

 private:
    std::vector<CausticSplat> splats_;  ///< by rows of luxels; in a row in the order of paths
};

}  // namespace mir
