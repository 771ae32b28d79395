// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/detail/tap_view.hpp"
#include "mir/film/filter.hpp"
#include "mir/film/luxel_grid.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mir::detail {

/// Which pixels the luxels of a cell reach, and with what weight. A tap is the offset of a pixel
/// from the luxel's own along one axis, moved to start at zero: tap reach() is the luxel's own
/// pixel. Reading it from several threads is safe.
class TapTable {
 public:
    /// Largest reach of any filter.
    static constexpr std::uint32_t most_reach = 16;

    using Range = TapRange;

    /// @throws Error(invalid_argument) for a filter that is too narrow, too wide or has no lobes.
    TapTable(const LuxelGrid& grid, const Filter& filter)
        : filter_(filter),
          reach_(checked_reach(filter)),
          centred_(grid.per_pixel() == 1 && grid.only == Vec2(0.5f, 0.5f)) {
        // The zeros of a filter may lie on the pixels around.
        while (centred_ && reach_ > 0 && filter.along(static_cast<float>(reach_)) == 0.0f) --reach_;
        columns_ = grid.per_pixel_x;
        for (std::uint32_t c = 0; c < grid.per_pixel_x; ++c)
            ranges_.push_back(range(c, grid.per_pixel_x));
        for (std::uint32_t c = 0; c < grid.per_pixel_y; ++c)
            ranges_.push_back(range(c, grid.per_pixel_y));
        if (filter.kind != FilterKind::box) tabulate();
    }

    /// Pixels are reached up to this far to each side.
    [[nodiscard]] std::uint32_t reach() const { return reach_; }
    /// Number of taps along one axis.
    [[nodiscard]] std::uint32_t taps() const { return 2 * reach_ + 1; }

    /// The taps of cell column `cx` that a luxel can reach. All others have weight zero.
    [[nodiscard]] Range x(std::uint32_t cx) const { return ranges_[cx]; }
    /// The same along y.
    [[nodiscard]] Range y(std::uint32_t cy) const { return ranges_[columns_ + cy]; }

    /// Sets weights[i] to the weight for `tap` of a luxel at `offsets[i]`. Offsets are in (0, 1),
    /// in the pixel.
    void weigh(std::uint32_t tap, std::span<const float> offsets, double* weights) const {
        if (filter_.kind == FilterKind::box) {
            for (std::size_t i = 0; i < offsets.size(); ++i)
                weights[i] =
                    TapView::box_weight(offsets[i] - 0.5f + shift(tap), filter_.half_width);
            return;
        }
        const float* const curve = view().curve(tap);
        for (std::size_t i = 0; i < offsets.size(); ++i)
            weights[i] = TapView::on_curve(curve, offsets[i]);
    }

    /// What kernels on the host read; valid until the table is moved or ends.
    [[nodiscard]] TapView view() const {
        return {reach_, filter_.half_width, curves_.empty() ? nullptr : curves_.data(),
                ranges_.data(), columns_};
    }
    /// The arrays of view().
    [[nodiscard]] std::span<const float> curves() const { return curves_; }
    [[nodiscard]] std::span<const TapRange> ranges() const { return ranges_; }

 private:
    static std::uint32_t checked_reach(const Filter& filter) {
        expects(filter.half_width >= 0.5f && filter.half_width <= 16.0f && filter.tau > 0.0f,
                "this pixel filter cannot be used (its half-width must lie in [0.5, 16] pixels, or "
                "luxels between the pixels would be lost, and its tau above 0); use "
                "filter_named(\"lanczos\")");
        return static_cast<std::uint32_t>(std::ceil(filter.half_width - 0.5f));
    }

    [[nodiscard]] float shift(std::uint32_t tap) const { return TapView::shift(reach_, tap); }

    /// Luxels never lie on the border of their cell.
    [[nodiscard]] Range range(std::uint32_t cell, std::uint32_t cells) const {
        const float low = static_cast<float>(cell) / static_cast<float>(cells) - 0.5f;
        const float high = static_cast<float>(cell + 1) / static_cast<float>(cells) - 0.5f;
        const auto misses = [&](std::uint32_t tap) {
            if (centred_) return filter_.along(shift(tap)) == 0.0f;
            return low + shift(tap) >= filter_.half_width ||
                   high + shift(tap) <= -filter_.half_width;
        };
        Range kept{0, taps()};
        while (kept.begin < reach_ && misses(kept.begin)) ++kept.begin;
        while (kept.end > reach_ + 1 && misses(kept.end - 1)) --kept.end;
        return kept;
    }

    void tabulate() {
        constexpr std::int32_t intervals = TapView::intervals;
        for (std::uint32_t tap = 0; tap < taps(); ++tap)
            for (std::int32_t i = 0; i <= intervals; ++i)
                curves_.push_back(
                    filter_.along(static_cast<float>(i) / float{intervals} - 0.5f + shift(tap)));
    }

    Filter filter_;
    std::uint32_t reach_;
    bool centred_;
    std::uint32_t columns_ = 0;
    std::vector<Range> ranges_;  ///< of cell columns, then of cell rows
    std::vector<float> curves_;  ///< of each tap, its weight over offsets from 0 to 1
};

}  // namespace mir::detail
