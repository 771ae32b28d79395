// SPDX-License-Identifier: MIT
#pragma once

#include "mir/normalise/normalise.hpp"
#include "runtime/image_bands.hpp"

#include <vector>

namespace mir {

/// The normalisation stage of a render. Finds what each VPL does to the image and makes intensities
/// of the radiance that the sampler gave (docs/method.md, 10).
class NormalisationPass {
 public:
    /// `bound` is that of the sampler's P_c and of the image.
    NormalisationPass(RenderFrame& frame, const ImageBands& bands, float bound)
        : frame_(frame), bands_(bands), bound_(bound) {}

    /// Replaces the radiance in `vpls` by intensities, by the policy of the settings.
    NormalisationReport run(VplList& vpls, double path_luminance, double states);

    /// All bands with their visibility, or none. They must fit into memory together and be needed.
    /// Leaves the pass without them.
    [[nodiscard]] std::vector<BandPtr> take_bands() { return std::move(kept_); }

 private:
    [[nodiscard]] std::vector<ImageResponse> over_image(VplSpan<Space::host> vpls);
    [[nodiscard]] std::vector<ImageResponse> probed(VplSpan<Space::host> vpls);
    void add(RenderFrame& by, const FrameBand& band, VplSpan<Space::host> vpls, BandTurn& turn,
             ResponseSum& sum) const;

    RenderFrame& frame_;
    const ImageBands& bands_;
    float bound_;
    std::vector<BandPtr> kept_;
};

}  // namespace mir
