// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/mean_luminances.hpp"
#include "runtime/render_frame.hpp"

#include <cstddef>
#include <vector>

namespace mir {

/// Adds luminances of a band's rows to a result. Row by row from top to bottom, so that bands
/// change nothing. Rows that were not asked for do not count; vectors may be empty.
inline void add_luminances(RenderJob& job, const FrameBand& band,
                           const std::vector<double>& indirect, const std::vector<double>& removed,
                           const std::vector<double>& residual) {
    const auto of = [](const std::vector<double>& rows, std::size_t y) {
        return rows.empty() ? 0.0 : rows[y];
    };
    for (std::uint32_t y = 0; y < band.extent().height; ++y) {
        if (!job.settings.rows.hold((band.first_row + y) / job.rays.grid.per_pixel_y)) continue;
        const RowLuminances row{of(indirect, y), of(removed, y), of(residual, y)};
        job.result.luminances.push_back(row);
        add_row(job.result.statistics, row);
    }
}

}  // namespace mir
