// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/cuts/vpl_bounds.hpp"
#include "mir/data/vpl_list.hpp"

#include <cmath>
#include <vector>

namespace mir {

/// Place of a VPL along one of six axes: its position, and its normal times `scale`.
MIR_HD inline float vpl_key(const Vpl& vpl, float scale, int axis) {
    return axis < 3 ? vpl.position[axis] : vpl.normal[axis - 3] * scale;
}

/// The first of the axes along which VPLs differ most, from their bounds along six.
MIR_HD inline std::uint32_t widest_axis(const float* low, const float* high) {
    std::uint32_t widest = 0;
    for (std::uint32_t a = 1; a < 6; ++a)
        if (high[a] - low[a] > high[widest] - low[widest]) widest = a;
    return widest;
}

/// The weight by which a VPL is picked, from 1 to 2^20 + 1. `most` is the root of the largest
/// luminance.
MIR_HD inline std::uint64_t pick_weight(const Vpl& vpl, float most) {
    constexpr float steps = 0x1p20f;
    const float share = std::sqrt(larger(luminance(vpl.intensity), 0.0f)) / most;
    return 1 + static_cast<std::uint64_t>(share * steps);
}

/// Whether a VPL has bounds: its intensity, place and normal are finite.
MIR_HD inline bool can_be_bounded(const Vpl& vpl) {
    return is_finite(vpl.intensity) &&
           is_finite(static_cast<double>(glm::dot(vpl.position, vpl.normal)));
}

/// @throws Error(invalid_argument) unless `all` VPLs can be bounded.
inline void expect_bounded(bool all) {
    expects(all,
            "a VPL has an intensity, a place or a normal that is not finite (a cut cannot bound "
            "it); leave such VPLs out");
}

/// The scale of normals on which opposite ones lie as far apart as a part of the scene.
inline float normal_scale_of(const VplBounds& all) {
    return 0.125f * glm::length(all.high - all.low);
}

/// The VPLs of a list that shine.
struct ShiningVpls {
    std::vector<VplIndex> order;  ///< in the list's order
    float most = 0.0f;            ///< root of the largest luminance
    float normal_scale = 0.0f;    ///< see normal_scale_of()

    /// @throws Error(invalid_argument) for an intensity, place or normal that is not finite.
    explicit ShiningVpls(VplSpan<Space::host> vpls) {
        VplBounds all;
        for (VplIndex j = 0; j < vpls.size(); ++j) {
            const Vpl& v = vpls[j];
            expect_bounded(can_be_bounded(v));
            if (is_black(v.intensity)) continue;
            order.push_back(j);
            all = all.with({v.position, v.position, luminance(v.intensity)});
        }
        most = std::sqrt(all.most);
        normal_scale = normal_scale_of(all);
    }
};

}  // namespace mir
