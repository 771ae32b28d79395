// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/settings.hpp"

namespace mir {

/// How good a picture is to be, and how long one waits for it.
enum class Quality : std::uint8_t {
    draft,  ///< a look: an eighth of the time of good, or less
    good,   ///< what one shows
    final   ///< about eight times the time of good
};

/// Settings of a quality. Light paths place so many VPLs that their number no longer shows, and
/// luxels pick few of them by cuts: so less error is left than all pairs of fewer VPLs leave in the
/// same time (docs/decisions/059). All other settings are those of RenderSettings{}.
[[nodiscard]] inline RenderSettings settings_for(Quality quality) {
    RenderSettings s;
    s.sampler = SamplerKind::instant_radiosity;
    s.compensate = 1;
    s.skip_faint_caustics = true;
    switch (quality) {
        case Quality::draft:
            s.luxels_per_pixel = 1;
            s.vpls = 1u << 16;
            s.picks = 64;
            s.direct_samples = 8;
            s.caustics = 1;
            break;
        case Quality::good:
            s.vpls = 1u << 18;
            s.picks = 256;
            break;
        case Quality::final:
            s.luxels_per_pixel = 16;
            s.vpls = 1u << 20;
            s.picks = 512;
            s.direct_samples = 128;
            s.caustics = 8;
            break;
    }
    return s;
}

}  // namespace mir
