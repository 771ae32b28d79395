// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/image_response.hpp"

#include <vector>

namespace mir::detail {

/// @throws Error(invalid_argument) unless tiles or bands are `whole` blocks.
inline void check_whole_blocks(bool whole) {
    expects(whole,
            "tiles or bands cut blocks of 16x16 luxels (the order of sums would depend on them); "
            "round sizes up with whole_blocks()");
}

/// The same of tiles.
inline void check_whole_blocks(const std::vector<Tile>& tiles) {
    bool whole = true;
    for (const Tile& t : tiles)
        whole = whole && t.x % BlockedLayout::side == 0 && t.y % BlockedLayout::side == 0;
    check_whole_blocks(whole);
}

/// Rows of blocks in so many rows of luxels.
[[nodiscard]] inline std::uint32_t block_rows(std::uint32_t luxel_rows) {
    return (luxel_rows + BlockedLayout::side - 1) / BlockedLayout::side;
}

/// Which rows a sum of responses has seen, and how sums become means.
class ResponseBands {
 public:
    ResponseBands(Extent luxels, std::uint32_t vpls) : luxels_(luxels), vpls_(vpls) {}

    [[nodiscard]] Extent luxels() const { return luxels_; }
    [[nodiscard]] std::uint32_t vpls() const { return vpls_; }

    /// @throws Error(invalid_argument) when the band is not the next one.
    void check(Extent band, std::uint32_t vpls) const {
        expects(
            vpls == vpls_ && band.width == luxels_.width && band.height <= luxels_.height - rows_,
            "a response was given luxels or VPLs of another image (it would be the mean of "
            "nothing); give the bands of one image from top to bottom");
        check_whole_blocks(rows_ % BlockedLayout::side == 0);
    }

    void count(Extent band) { rows_ += band.height; }

    [[nodiscard]] std::uint32_t rows() const { return rows_; }

    /// @throws Error(invalid_argument) for rows or VPLs of another image.
    void go_on(std::uint32_t rows, std::size_t vpls) {
        expects(vpls == vpls_ && rows <= luxels_.height,
                "a response was to go on from sums of another image or other VPLs; give it those "
                "of the same picture");
        rows_ = rows;
    }

    /// @throws Error(invalid_argument) before all rows were added.
    [[nodiscard]] std::vector<ImageResponse> mean(std::vector<ImageResponse> sums) const {
        expects(rows_ == luxels_.height,
                "a response was asked for before every row of the image was added (the mean is "
                "over all luxels); add the bands that are missing");
        const double share = 1.0 / static_cast<double>(luxels_.area());
        for (ImageResponse& m : sums) m = {m.r * share, m.g * share, m.b * share, m.lit_luxels};
        return sums;
    }

 private:
    Extent luxels_;
    std::uint32_t vpls_;
    std::uint32_t rows_ = 0;
};

}  // namespace mir::detail
