// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/film/tap_table.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mir::detail {

/// Pixel columns that are filtered together. Wide, so that the luxels around them, which the
/// neighbouring columns weigh once more, are few; narrow enough for the first-level cache.
inline constexpr std::uint32_t film_columns = 64;

/// One luxel row, as far as film_columns pixel columns need it, in planes by cell. Neighbours in
/// memory are the luxels of one cell in neighbouring pixels. What pixel i needs for one cell and
/// tap then lies at the same distance for every i, and a vector register takes several pixels. For
/// one thread.
class LuxelColumns {
 public:
    /// For pixels from column `first_pixel` on; `grid` and `taps` must outlive this.
    LuxelColumns(const LuxelGrid& grid, const TapTable& taps, std::uint64_t seed,
                 std::uint32_t first_pixel, std::size_t layers)
        : grid_(grid),
          taps_(taps),
          seed_(seed),
          begin_(first_pixel - std::min(first_pixel, taps.reach())),
          count_(std::min(first_pixel + film_columns + taps.reach(), grid.pixels.width) - begin_),
          margin_(begin_ + taps.reach() - first_pixel),
          x_(cells() * taps.taps() * stride),
          y_(cells() * taps.taps() * stride),
          values_(layers * 3 * cells() * stride),
          products_(3 * cells() * stride) {
        patterns_.reserve(count_);
    }

    /// Weighs the luxels of `row`.
    void place(std::uint32_t row);

    /// Takes the radiance of a layer from a complete luxel row.
    void load(std::size_t layer, const Rgb* row);

    /// Adds the weights of the luxels at `tap_y` to film_columns sums.
    void add_weights(std::uint32_t tap_y, double* sums) {
        for (std::uint32_t c = 0; c < cells(); ++c)
            std::copy_n(weights(y_, c, tap_y), needed(), products_.data() + c * stride);
        add_products<1>(sums);
    }

    /// Adds the weighted radiance of `layer` to film_columns sums of red, then green, then blue.
    void add_layer(std::size_t layer, std::uint32_t tap_y, double* sums);

 private:
    // Known to the compiler, so that all planes of a luxel lie at fixed distances.
    static constexpr std::size_t stride = film_columns + 2 * TapTable::most_reach;

    [[nodiscard]] std::size_t cells() const { return grid_.per_pixel_x; }
    /// Places of a plane that are in use.
    [[nodiscard]] std::uint32_t needed() const { return film_columns + 2 * taps_.reach(); }
    /// Plane of a cell and tap in x_ or y_.
    [[nodiscard]] double* weights(std::vector<double>& planes, std::size_t cell,
                                  std::uint32_t tap) const {
        return planes.data() + (cell * taps_.taps() + tap) * stride;
    }
    /// Planes of red, green and blue.
    [[nodiscard]] float* values(std::size_t layer, std::size_t cell) {
        return values_.data() + (layer * cells() + cell) * 3 * stride;
    }

    void choose_patterns(std::uint32_t pixel_row);
    void weigh(std::vector<double>& planes, std::size_t cell, TapTable::Range range,
               const float* offsets);
    template <std::uint32_t channels>
    void add_products(double* sums);
    template <std::uint32_t channels, std::uint32_t taps>
    static void add_taps(const double* weight, const double* product, double* __restrict sums);

    const LuxelGrid& grid_;
    const TapTable& taps_;
    std::uint64_t seed_;
    std::uint32_t begin_;   ///< first pixel whose luxels count
    std::uint32_t count_;   ///< number of such pixels
    std::uint32_t margin_;  ///< places before them that lie outside the image, with weight zero
    std::uint32_t pattern_row_ = 0;
    std::vector<PixelPattern> patterns_;
    std::vector<double> x_;
    std::vector<double> y_;
    std::vector<float> values_;
    std::vector<double> products_;
};

inline void LuxelColumns::choose_patterns(std::uint32_t pixel_row) {
    if (!patterns_.empty() && pattern_row_ == pixel_row) return;
    pattern_row_ = pixel_row;
    patterns_.clear();
    for (std::uint32_t i = 0; i < count_; ++i)
        patterns_.push_back(grid_.pattern(begin_ + i, pixel_row, seed_));
}

inline void LuxelColumns::weigh(std::vector<double>& planes, std::size_t cell,
                                TapTable::Range range, const float* offsets) {
    for (std::uint32_t tap = range.begin; tap < range.end; ++tap)
        taps_.weigh(tap, {offsets, count_}, weights(planes, cell, tap) + margin_);
}

inline void LuxelColumns::place(std::uint32_t row) {
    // Luxels alone in their pixels have the same weights in every row.
    if (grid_.per_pixel() == 1 && !patterns_.empty()) return;
    choose_patterns(row / grid_.per_pixel_y);
    const std::uint32_t cy = row % grid_.per_pixel_y;
    for (std::uint32_t cx = 0; cx < cells(); ++cx) {
        float x[stride], y[stride];
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Vec2 offset = patterns_[i](cx, cy);
            x[i] = offset.x;
            y[i] = offset.y;
        }
        weigh(x_, cx, taps_.x(cx), x);
        weigh(y_, cx, taps_.y(cy), y);
    }
}

inline void LuxelColumns::load(std::size_t layer, const Rgb* row) {
    const Rgb* luxel = row + begin_ * cells();
    for (std::uint32_t i = margin_; i < margin_ + count_; ++i)
        for (std::uint32_t c = 0; c < cells(); ++c, ++luxel) {
            float* const value = values(layer, c) + i;
            value[0] = luxel->r;
            value[stride] = luxel->g;
            value[2 * stride] = luxel->b;
        }
}

inline void LuxelColumns::add_layer(std::size_t layer, std::uint32_t tap_y, double* sums) {
    for (std::uint32_t c = 0; c < cells(); ++c) {
        const double* const weight = weights(y_, c, tap_y);
        const float* const value = values(layer, c);
        double* const product = products_.data() + std::size_t{3} * c * stride;
        for (std::uint32_t k = 0; k < 3; ++k)
            for (std::uint32_t i = 0; i < needed(); ++i)
                product[k * stride + i] = weight[i] * static_cast<double>(value[k * stride + i]);
    }
    add_products<3>(sums);
}

/// Adds the products of all cells, each for its taps along x.
template <std::uint32_t channels>
void LuxelColumns::add_products(double* sums) {
    for (std::uint32_t c = 0; c < cells(); ++c) {
        const auto [begin, end] = taps_.x(c);
        const double* const weight = weights(x_, c, 0) + std::size_t{2} * taps_.reach();
        const double* const product =
            products_.data() + std::size_t{channels} * c * stride + std::size_t{2} * taps_.reach();
        std::uint32_t tap = begin;
        for (; tap + 3 <= end; tap += 3)
            add_taps<channels, 3>(weight + tap * (stride - 1), product - tap, sums);
        for (; tap < end; ++tap)
            add_taps<channels, 1>(weight + tap * (stride - 1), product - tap, sums);
    }
}

/// Adds neighbouring taps. The further right the pixel, the further left in its plane the luxel.
template <std::uint32_t channels, std::uint32_t taps>
void LuxelColumns::add_taps(const double* weight, const double* product, double* __restrict sums) {
    for (std::uint32_t i = 0; i < film_columns; ++i)
        for (std::uint32_t k = 0; k < channels; ++k) {
            double sum = sums[k * film_columns + i];
            for (std::uint32_t t = 0; t < taps; ++t)
                sum += weight[t * (stride - 1) + i] * (product - t)[k * stride + i];
            sums[k * film_columns + i] = sum;
        }
}

}  // namespace mir::detail
