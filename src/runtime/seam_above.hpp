// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/film_seam.hpp"
#include "mir/film/tap_table.hpp"
#include "runtime/render_job.hpp"

#include <cstddef>
#include <cstdint>

namespace mir {

/// Where a film of so many layers goes on with luxel row `row`. That is where another one ended,
/// `seam`, if any did, else below nothing: rows above are not asked for (RenderSettings::rows).
inline FilmSeam seam_above(const RenderJob& job, std::uint32_t row, std::size_t layers,
                           const FilmSeam* seam) {
    if (seam != nullptr && seam->luxel_rows > 0) return *seam;
    const LuxelGrid& grid = job.rays.grid;
    const std::uint32_t reach = detail::TapTable(grid, job.settings.filter).reach();
    FilmSeam black = FilmSeam::below(row, grid, reach);
    black.sums.resize(black.count(grid, 1 + 3 * layers));
    return black;
}

}  // namespace mir
