// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/caustic_paths.hpp"
#include "runtime/image_bands.hpp"

#include <vector>

namespace mir {

/// Luminances of a band's rows, W m^-2 sr^-1; empty where no caustics are traced.
struct CausticRows {
    std::vector<double> all;     ///< of all caustics
    std::vector<double> direct;  ///< of those that belong to direct light
};

/// Who looks at the caustics of a render.
[[nodiscard]] inline CausticView caustic_view(const RenderJob& job) {
    return {job.rays.camera.optics(), job.aspect(), job.rays.grid.luxels()};
}

/// Light that mirrors and glass throw on the surfaces of a render, by paths of its frame. Those
/// from the lights are traced at once, as they may end anywhere; what luxels see in mirrors and
/// through bodies is traced back band by band.
class CausticLight {
 public:
    /// Traces the light paths, where the settings want them and the scene bends rays. Of what they
    /// bring only that to rows of `bands` is kept, a sum for each luxel.
    /// @throws Error(cancelled)
    CausticLight(RenderFrame& frame, const ImageBands& bands);

    /// Adds all to a band's layers (FilmLayer): what lamps send to direct light, the rest to
    /// indirect light and to the bounces where there are any. Several threads may add, to a band
    /// each.
    /// @throws Error(cancelled)
    [[nodiscard]] CausticRows add(RenderFrame& by, const FrameBand& band,
                                  std::vector<LayerPtr>& layers) const;

 private:
    bool is_traced_ = false;            ///< whether there are caustics
    std::vector<CausticSplat> splats_;  ///< of light paths, by rows of luxels
};

}  // namespace mir
