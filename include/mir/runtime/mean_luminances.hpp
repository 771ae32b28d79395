// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"

namespace mir {

/// Forgets the mean luminances that add_row() adds to.
inline void clear_rows(RenderStatistics& s) {
    s.indirect_luminance = s.removed_luminance = s.residual_luminance = s.caustic_luminance = 0.0;
    s.caustic_direct_luminance = 0.0;
}

/// Adds a row of luxels to the mean luminances of an image, whose luxels are counted. Rows go from
/// top to bottom: the order of the sum decides its last bits.
inline void add_row(RenderStatistics& s, const RowLuminances& row) {
    const double share = 1.0 / static_cast<double>(s.luxels);
    s.indirect_luminance += row.indirect * share;
    s.removed_luminance += row.removed * share;
    s.residual_luminance += row.residual * share;
    s.caustic_luminance += row.caustic * share;
    s.caustic_direct_luminance += row.caustic_direct * share;
}

}  // namespace mir
