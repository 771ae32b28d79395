// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/film/luxel_grid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mir {

/// Where a film ends between two luxel rows and another goes on. It holds the sums of the pixels
/// that rows on both sides reach; both films are of the same image. The other adds to them, so that
/// they are those of one film, bit by bit.
struct FilmSeam {
    std::uint32_t luxel_rows = 0;  ///< added to films so far; 0: nothing begun
    std::uint32_t first_row = 0;   ///< of pixels: those above are finished
    std::uint32_t rows = 0;        ///< of pixels that both sides reach
    std::vector<double> sums;  ///< planes of `rows` rows: weights, then red, green, blue of each
                               ///< layer

    /// The seam below `luxel_rows` whole rows of pixels, without sums. Filters reach so far to each
    /// side.
    [[nodiscard]] static FilmSeam below(std::uint32_t luxel_rows, const LuxelGrid& grid,
                                        std::uint32_t reach) {
        FilmSeam seam;
        seam.luxel_rows = luxel_rows;
        const std::uint32_t height = grid.pixels.height;
        const std::uint32_t complete = luxel_rows / grid.per_pixel_y;
        const bool is_whole = complete == height;
        seam.first_row = is_whole ? height : complete - std::min(complete, reach);
        if (complete > 0 && !is_whole)
            seam.rows = std::min(height, complete + reach) - seam.first_row;
        return seam;
    }

    /// Sums of a film with so many planes.
    [[nodiscard]] std::size_t count(const LuxelGrid& grid, std::size_t planes) const {
        return planes * rows * grid.pixels.width;
    }
};

/// Checks that a film can go on below a seam. It has `planes` of sums and a filter of such a reach;
/// `luxel_rows` were added to it.
/// @throws Error(invalid_argument) when it cannot.
inline void check_seam(const FilmSeam& seam, const LuxelGrid& grid, std::uint32_t reach,
                       std::size_t planes, std::uint32_t luxel_rows) {
    const FilmSeam wanted = FilmSeam::below(seam.luxel_rows, grid, reach);
    expects(seam.luxel_rows <= grid.luxels().height && seam.luxel_rows >= luxel_rows &&
                seam.luxel_rows % grid.per_pixel_y == 0 && seam.first_row == wanted.first_row &&
                seam.rows == wanted.rows && seam.sums.size() == wanted.count(grid, planes),
            "a film was to go on below a seam of another image, filter or layers, or above rows "
            "that it has; give it what a film of the same picture left");
}

}  // namespace mir
