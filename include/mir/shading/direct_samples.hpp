// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstdint>

namespace mir {

/// From where a luxel's direct light comes. Lights without extent always give theirs.
struct DirectSamples {
    std::uint32_t emitters = 0;     ///< points on emissive triangles
    std::uint32_t environment = 0;  ///< directions towards the environment
    bool distant_vpls = false;  ///< all luxels share these directions, which are VPLs at infinity;
                                ///< otherwise each pixel draws its own

    bool guides_sky = true;  ///< directions go where rays to the environment come through

    /// As many points on lamps as directions, of each luxel's own. Implicit: a count says it all.
    MIR_HD DirectSamples(std::uint32_t each) : emitters(each), environment(each) {}

    /// Nothing from lamps, on which VPLs lie, and `count` VPLs at infinity.
    [[nodiscard]] static MIR_HD DirectSamples vpls(std::uint32_t count) {
        DirectSamples s(0);
        s.environment = count;
        s.distant_vpls = true;
        return s;
    }

    /// True when a SkyGuide pays: fewer directions than it tries are not worth it.
    [[nodiscard]] MIR_HD bool want_sky_guide() const {
        return guides_sky && !distant_vpls && environment >= 4;
    }
};

}  // namespace mir
