// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/filter.hpp"
#include "mir/film/luxel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mir::detail {

/// Filter weights of a band of luxel rows, computed once per luxel and axis instead of once per
/// luxel and pixel. A tap is the offset of a pixel from the luxel's own, moved to start at zero.
/// One thread may prepare; then any number may read.
class TapTable {
 public:
    /// @throws Error(invalid_argument) for a filter that is too narrow, too wide or has no lobes.
    TapTable(const LuxelGrid& grid, const Filter& filter, std::uint64_t seed)
        : grid_(grid), filter_(filter), seed_(seed), reach_(checked_reach(filter)) {
        if (!jittered()) share_one_luxel();
    }

    /// Pixels are reached up to this far to each side.
    [[nodiscard]] std::uint32_t reach() const { return reach_; }

    /// Most rows that prepare() takes: bounds the table at 64 MiB, whatever the band.
    [[nodiscard]] std::uint32_t max_rows() const {
        constexpr std::uint64_t bytes = 64ull << 20;
        const std::uint64_t row = std::uint64_t{2} * taps() * grid_.luxels().width * sizeof(float);
        return static_cast<std::uint32_t>(std::max<std::uint64_t>(bytes / row, 1));
    }

    /// Computes the weights of luxel rows [first, last), at most max_rows() of them.
    template <class E>
    void prepare(E& executor, std::uint32_t first, std::uint32_t last) {
        if (!jittered()) return;
        first_ = first;
        const std::size_t needed = std::size_t{last - first} * grid_.luxels().width * taps();
        if (x_.size() < needed) x_.resize(needed);
        if (y_.size() < needed) y_.resize(needed);
        const std::uint32_t top = first / grid_.per_pixel_y;
        const std::uint32_t bottom = (last - 1) / grid_.per_pixel_y;
        executor.for_each(bottom - top + 1, [&](std::size_t i) {
            prepare_pixel_row(top + static_cast<std::uint32_t>(i), first, last);
        });
    }

    /// Weights of luxel `x` along x for taps 0 .. 2 reach().
    [[nodiscard]] const float* x(std::uint32_t x, std::uint32_t row) const {
        if (!jittered()) return x_.data();
        return x_.data() + (std::size_t{row - first_} * grid_.luxels().width + x) * taps();
    }

    /// Weight of luxel `x` along y for one tap.
    [[nodiscard]] float y(std::uint32_t x, std::uint32_t row, std::uint32_t tap) const {
        if (!jittered()) return x_[tap];
        return y_[y_index(x, row, tap)];
    }

 private:
    static std::uint32_t checked_reach(const Filter& filter) {
        expects(filter.half_width >= 0.5f && filter.half_width <= 16.0f && filter.tau > 0.0f,
                "this pixel filter cannot be used (its half-width must lie in [0.5, 16] pixels, or "
                "luxels between the pixels would be lost, and its tau above 0); use "
                "filter_named(\"lanczos\")");
        return static_cast<std::uint32_t>(std::ceil(filter.half_width - 0.5f));
    }

    [[nodiscard]] bool jittered() const { return grid_.per_pixel() > 1; }
    [[nodiscard]] std::uint32_t taps() const { return 2 * reach_ + 1; }

    // Taps are the slowest index here: a pixel row reads one tap of all luxels.
    [[nodiscard]] std::size_t y_index(std::uint32_t x, std::uint32_t row, std::uint32_t tap) const {
        return (std::size_t{row - first_} * taps() + tap) * grid_.luxels().width + x;
    }

    /// Luxels at pixel centres all have the same weights, most often zeros far out.
    void share_one_luxel() {
        while (reach_ > 0 && filter_.along(static_cast<float>(reach_)) == 0.0f) --reach_;
        for (std::uint32_t tap = 0; tap < taps(); ++tap) x_.push_back(weight(0.5f, tap));
    }

    /// `offset` of a luxel in its pixel, 0 to 1.
    [[nodiscard]] float weight(float offset, std::uint32_t tap) const {
        return filter_.along(offset - 0.5f + static_cast<float>(reach_) - static_cast<float>(tap));
    }

    void prepare_pixel_row(std::uint32_t py, std::uint32_t first, std::uint32_t last) {
        const std::uint32_t begin = std::max(first, py * grid_.per_pixel_y);
        const std::uint32_t end = std::min(last, (py + 1) * grid_.per_pixel_y);
        for (std::uint32_t px = 0; px < grid_.pixels.width; ++px) {
            const PixelPattern pattern = grid_.pattern(px, py, seed_);
            for (std::uint32_t row = begin; row < end; ++row)
                for (std::uint32_t cx = 0; cx < grid_.per_pixel_x; ++cx)
                    store(px * grid_.per_pixel_x + cx, row,
                          pattern(cx, row - py * grid_.per_pixel_y));
        }
    }

    void store(std::uint32_t x, std::uint32_t row, Vec2 offset) {
        float* const along_x =
            x_.data() + (std::size_t{row - first_} * grid_.luxels().width + x) * taps();
        for (std::uint32_t tap = 0; tap < taps(); ++tap) {
            along_x[tap] = weight(offset.x, tap);
            y_[y_index(x, row, tap)] = weight(offset.y, tap);
        }
    }

    LuxelGrid grid_;
    Filter filter_;
    std::uint64_t seed_;
    std::uint32_t reach_;
    std::uint32_t first_ = 0;
    std::vector<float> x_;
    std::vector<float> y_;
};

}  // namespace mir::detail
