// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"

namespace mir {

/// Adds a row of luxels to the mean luminances of an image, whose luxels are counted. Rows go from
/// top to bottom: the order of the sum decides its last bits.
inline void add_row(RenderStatistics& s, const RowLuminances& row) {
    const double share = 1.0 / static_cast<double>(s.luxels);
    s.indirect_luminance += row.indirect * share;
    s.removed_luminance += row.removed * share;
    s.residual_luminance += row.residual * share;
}

}  // namespace mir
