// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/mean_luminances.hpp"
#include "runtime/render_frame.hpp"

#include <cstddef>
#include <vector>

namespace mir {

/// Luminances of a band's rows, as those of RowLuminances. Vectors may be empty.
struct BandLuminances {
    const std::vector<double>& indirect;
    const std::vector<double>& removed;
    const std::vector<double>& residual;
    const std::vector<double>& caustic;
    const std::vector<double>& caustic_direct;
    const std::vector<double>& direct;
};

/// Adds luminances of a band's rows to a result. Row by row from top to bottom, so that bands
/// change nothing. Rows that were not asked for do not count.
inline void add_luminances(RenderJob& job, const FrameBand& band, const BandLuminances& of_rows) {
    const auto of = [](const std::vector<double>& rows, std::size_t y) {
        return rows.empty() ? 0.0 : rows[y];
    };
    for (std::uint32_t y = 0; y < band.extent().height; ++y) {
        if (!job.settings.rows.hold((band.first_row + y) / job.rays.grid.per_pixel_y)) continue;
        const RowLuminances row{of(of_rows.indirect, y),       of(of_rows.removed, y),
                                of(of_rows.residual, y),       of(of_rows.caustic, y),
                                of(of_rows.caustic_direct, y), of(of_rows.direct, y)};
        job.result.luminances.push_back(row);
        add_row(job.result.statistics, row);
    }
}

}  // namespace mir
