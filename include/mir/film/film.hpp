// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/film/detail/luxel_columns.hpp"
#include "mir/film/film_seam.hpp"
#include "mir/film/filter.hpp"
#include "mir/film/luxel_grid.hpp"
#include "mir/film/tap_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mir {

/// Turns the radiance of luxels into pixels through a filter. L_pixel = sum(w L) / sum(w) over the
/// luxels that the filter reaches. Accumulation is signed: the negative lobes of a filter stay, and
/// with them negative pixels next to strong edges; only a display clamps. A film holds one or
/// several layers (direct light, emission, ...) that share the weights, which cost more than a
/// layer.
///
/// Every pixel adds its luxels row by row, in a row cell column by cell column, in that from right
/// to left. So the result is equal in every bit for any cut into bands, any number of threads or
/// layers and any instruction set. Sums are kept in double: a pixel adds up to 4096 terms of either
/// sign (64 luxels under a half-width of 4), and radiances next to an emitter differ by many orders
/// of magnitude, where the cancellation of float sums would show.
///
/// One thread at a time may use a Film; it spreads its work through the executor it is given. Where
/// an exception ends add_rows(), part of a band may be added: the film then refuses all further
/// use.
class Film {
 public:
    /// `grid` and `seed` must be those that placed the luxels. `instructions` never changes a bit.
    /// @throws Error(invalid_argument) when the filter's half-width lies outside [0.5, 16] pixels,
    ///         its tau is not positive or there is no layer.
    Film(const LuxelGrid& grid, const Filter& filter, std::uint64_t seed, std::size_t layers = 1,
         InstructionSet instructions = best_instruction_set())
        : grid_(grid),
          taps_(grid, filter),
          seed_(seed),
          layers_(checked_layers(layers)),
          // Measured: AVX-512 gains nothing in the sums and is slower at table look-ups.
          instructions_(std::min(instructions, InstructionSet::avx2)),
          sums_(std::size_t{grid.pixels.height} * blocks() * planes() * detail::film_columns) {}

    /// Adds a band of complete luxel rows, one image for each layer. Radiance is in W m^-2 sr^-1.
    /// Bands come from top to bottom without gaps; their heights are free.
    /// @throws Error(invalid_argument) when the number of images is not that of the layers, or a
    ///         band has the wrong width, does not start where the last one ended, does not fit into
    ///         the grid or differs in height from that of the first layer; what the executor
    ///         throws, after which the film cannot be used.
    template <Executor E>
    void add_rows(E& executor, std::uint32_t first_luxel_row,
                  std::span<const Image<Rgb>* const> layers);

    /// The same for images that lie in one array.
    template <Executor E>
    void add_rows(E& executor, std::uint32_t first_luxel_row,
                  const std::vector<Image<Rgb>>& layers) {
        std::vector<const Image<Rgb>*> places;
        for (const Image<Rgb>& layer : layers) places.push_back(&layer);
        add_rows(executor, first_luxel_row, std::span<const Image<Rgb>* const>(places));
    }

    /// The same for a film of one layer.
    template <Executor E>
    void add_rows(E& executor, std::uint32_t first_luxel_row, const Image<Rgb>& luxels) {
        const Image<Rgb>* const layer = &luxels;
        add_rows(executor, first_luxel_row, std::span<const Image<Rgb>* const>(&layer, 1));
    }

    /// The same on the calling thread.
    void add_rows(std::uint32_t first_luxel_row, const Image<Rgb>& luxels) {
        InlineExecutor executor;
        add_rows(executor, first_luxel_row, luxels);
    }

    /// The pixels of a layer, radiance in W m^-2 sr^-1. May be called between bands: rows of pixels
    /// whose own luxels are not complete are black, the others are filtered from what is there, as
    /// at the border of an image. A pixel whose weights cancel to less than a thousandth of its
    /// luxels is black too; no filter of default_filter() lets that happen.
    /// @throws Error(invalid_argument) when there is no such layer, or a band was added in part.
    template <Executor E>
    [[nodiscard]] Image<Rgb> develop(E& executor, std::size_t layer) const;

    /// Develops rows of pixels alone, from `first` up to `end`, into an image.
    /// @throws Error(invalid_argument) as develop(), or when the image has another size or lacks
    ///         the rows.
    template <Executor E>
    void develop_rows(E& executor, std::size_t layer, std::uint32_t first, std::uint32_t end,
                      Image<Rgb>& image) const;

    /// The same on the calling thread.
    [[nodiscard]] Image<Rgb> develop(std::size_t layer = 0) const {
        InlineExecutor executor;
        return develop(executor, layer);
    }

    /// What another film needs to go on below the rows added so far. They are rows of whole pixels.
    /// It develops the pixels from FilmSeam::first_row on, this one those above.
    /// @throws Error(invalid_argument) when a band was added in part.
    [[nodiscard]] FilmSeam seam() const;

    /// Goes on below another film of the same image, filter and layers. That film left `seam`: only
    /// pixels from there on mean anything.
    /// @throws Error(invalid_argument) when the seam is not one of such a film, lies above rows
    ///         that were added, or a band was added in part.
    void go_on(const FilmSeam& seam);

    /// Pixels and luxels that it was made for.
    [[nodiscard]] const LuxelGrid& grid() const { return grid_; }
    /// Number of layers.
    [[nodiscard]] std::size_t layers() const { return layers_; }
    /// Luxel rows added so far.
    [[nodiscard]] std::uint32_t rows() const { return rows_; }

 private:
    static std::size_t checked_layers(std::size_t layers) {
        expects(layers > 0,
                "a film without layers was asked for (there is nothing to keep); give "
                "it at least one layer");
        return layers;
    }

    void check_whole() const {
        expects(
            !in_part_,
            "a film was used to which a band was added in part (an exception ended add_rows()); "
            "make a new film and add all bands again");
    }
    void check_band(std::uint32_t first_luxel_row, const Image<Rgb>& luxels) const;
    void check_layers(std::uint32_t first_luxel_row,
                      std::span<const Image<Rgb>* const> layers) const;
    /// Adds the band to one block of pixel columns.
    void add_to_block(std::uint32_t block, std::uint32_t first_luxel_row,
                      std::span<const Image<Rgb>* const> layers);
    void add_luxel_row(detail::LuxelColumns& luxels, std::uint32_t block, std::uint32_t row);
    /// Calls use(seam_sum, index into sums_) for all sums of a seam.
    template <class Seam, class Use>
    void for_each_sum(Seam& seam, const Use& use) const;

    /// A plane of weights, then three of each layer.
    [[nodiscard]] std::size_t planes() const { return 1 + 3 * layers_; }
    [[nodiscard]] std::uint32_t blocks() const {
        return (grid_.pixels.width - 1) / detail::film_columns + 1;
    }
    /// Index of the first sum of a block of columns in pixel row `py`.
    [[nodiscard]] std::size_t sums_of(std::uint32_t block, std::uint32_t py) const {
        return (std::size_t{py} * blocks() + block) * planes() * detail::film_columns;
    }

    LuxelGrid grid_;
    detail::TapTable taps_;
    std::uint64_t seed_;
    std::size_t layers_;
    InstructionSet instructions_;
    std::vector<double> sums_;
    std::uint32_t rows_ = 0;
    bool in_part_ = false;  ///< a band is being added, or an exception ended that
};

inline void Film::check_band(std::uint32_t first_luxel_row, const Image<Rgb>& luxels) const {
    const Extent whole = grid_.luxels();
    if (luxels.width() == whole.width && first_luxel_row == rows_ &&
        luxels.height() <= whole.height - rows_)
        return;
    throw Error(ErrorCode::invalid_argument,
                "a band of " + std::to_string(luxels.width()) + "x" +
                    std::to_string(luxels.height()) + " luxels from row " +
                    std::to_string(first_luxel_row) + " cannot be added to a film of " +
                    std::to_string(whole.width) + "x" + std::to_string(whole.height) +
                    " luxels that has " + std::to_string(rows_) +
                    " rows (bands are complete rows from top to bottom); add the band that starts "
                    "at row " +
                    std::to_string(rows_));
}

inline void Film::check_layers(std::uint32_t first_luxel_row,
                               std::span<const Image<Rgb>* const> layers) const {
    if (layers.size() != layers_)
        throw Error(ErrorCode::invalid_argument,
                    "a band of " + std::to_string(layers.size()) +
                        " images cannot be added to a film of " + std::to_string(layers_) +
                        " layers (a band has one image for each layer); add all layers at once");
    for (const Image<Rgb>* const layer : layers) {
        check_band(first_luxel_row, *layer);
        expects(layer->height() == layers.front()->height(),
                "the layers of a band differ in height (they show the same luxels); add the same "
                "rows of every layer");
    }
}

template <Executor E>
void Film::add_rows(E& executor, std::uint32_t first_luxel_row,
                    std::span<const Image<Rgb>* const> layers) {
    check_whole();
    check_layers(first_luxel_row, layers);
    in_part_ = true;
    executor.for_each(blocks(), [&](std::size_t block) {
        run_with(instructions_,
                 [&] { add_to_block(static_cast<std::uint32_t>(block), first_luxel_row, layers); });
    });
    rows_ += layers.front()->height();
    in_part_ = false;
}

inline void Film::add_to_block(std::uint32_t block, std::uint32_t first_luxel_row,
                               std::span<const Image<Rgb>* const> layers) {
    detail::LuxelColumns luxels(grid_, taps_, seed_, block * detail::film_columns, layers_);
    for (std::uint32_t y = 0; y < layers.front()->height(); ++y) {
        luxels.place(first_luxel_row + y);
        for (std::size_t layer = 0; layer < layers_; ++layer)
            luxels.load(layer, &(*layers[layer])(0, y));
        add_luxel_row(luxels, block, first_luxel_row + y);
    }
}

inline void Film::add_luxel_row(detail::LuxelColumns& luxels, std::uint32_t block,
                                std::uint32_t row) {
    const auto [begin, end] = taps_.y(row % grid_.per_pixel_y);
    for (std::uint32_t tap = begin; tap < end; ++tap) {
        const std::int64_t py =
            std::int64_t{row / grid_.per_pixel_y} + tap - std::int64_t{taps_.reach()};
        if (py < 0 || py >= std::int64_t{grid_.pixels.height}) continue;
        double* const sums = sums_.data() + sums_of(block, static_cast<std::uint32_t>(py));
        luxels.add_weights(tap, sums);
        for (std::size_t layer = 0; layer < layers_; ++layer)
            luxels.add_layer(layer, tap, sums + (1 + 3 * layer) * detail::film_columns);
    }
}

template <class Seam, class Use>
void Film::for_each_sum(Seam& seam, const Use& use) const {
    auto sum = seam.sums.begin();
    for (std::size_t plane = 0; plane < planes(); ++plane)
        for (std::uint32_t y = seam.first_row; y < seam.first_row + seam.rows; ++y)
            for (std::uint32_t x = 0; x < grid_.pixels.width; ++x)
                use(*sum++, sums_of(x / detail::film_columns, y) + plane * detail::film_columns +
                                x % detail::film_columns);
}

inline FilmSeam Film::seam() const {
    check_whole();
    FilmSeam seam = FilmSeam::below(rows_, grid_, taps_.reach());
    seam.sums.resize(seam.count(grid_, planes()));
    for_each_sum(seam, [this](double& sum, std::size_t i) { sum = sums_[i]; });
    return seam;
}

inline void Film::go_on(const FilmSeam& seam) {
    check_whole();
    check_seam(seam, grid_, taps_.reach(), planes(), rows_);
    for_each_sum(seam, [this](const double& sum, std::size_t i) { sums_[i] = sum; });
    rows_ = seam.luxel_rows;
}

template <Executor E>
Image<Rgb> Film::develop(E& executor, std::size_t layer) const {
    Image<Rgb> image(grid_.pixels);
    develop_rows(executor, layer, 0, grid_.pixels.height, image);
    return image;
}

template <Executor E>
void Film::develop_rows(E& executor, std::size_t layer, std::uint32_t first, std::uint32_t end,
                        Image<Rgb>& image) const {
    check_whole();
    expects(layer < layers_,
            "a layer was asked for that the film does not hold (layers are numbered from 0); ask "
            "for one below layers()");
    expects(image.extent() == grid_.pixels && first <= end && end <= grid_.pixels.height,
            "a film was to be developed into an image of another size, or into rows that it lacks; "
            "give an image of the film's pixels and rows of it");
    const double least = 1e-3 * grid_.per_pixel();
    const std::uint32_t complete = rows_ / grid_.per_pixel_y;
    executor.for_each(end - first, [&](std::size_t row) {
        const std::uint32_t y = first + static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < grid_.pixels.width; ++x) {
            image(x, y) = {};
            if (y >= complete) continue;
            const double* const sums = sums_.data() + sums_of(x / detail::film_columns, y);
            const double weight = sums[x % detail::film_columns];
            if (std::fabs(weight) < least) continue;
            const double* const red =
                sums + (1 + 3 * layer) * detail::film_columns + x % detail::film_columns;
            constexpr std::size_t plane = detail::film_columns;
            image(x, y) = {static_cast<float>(red[0] / weight),
                           static_cast<float>(red[plane] / weight),
                           static_cast<float>(red[2 * plane] / weight)};
        }
    });
}

}  // namespace mir
