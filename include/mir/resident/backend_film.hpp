// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/image.hpp"
#include "mir/film/film_pass.hpp"
#include "mir/film/film_seam.hpp"
#include "mir/film/tap_table.hpp"
#include "mir/resident/backend_layer.hpp"
#include "mir/resident/bring_rows.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "mir/resident/wait_at_end.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace mir {

/// Film on a backend. Luxels that lie there become pixels there, with the bits of Film, and come
/// home when they are finished. Memory grows with the height of a band, not of the image: sums of
/// pixels take turns in a ring of rows. One queue and one thread at a time.
template <Backend B>
class BackendFilm {
 public:
    /// Of the backend.
    using Queue = typename B::Queue;

    /// `grid` and `seed` must be those that placed the luxels. Bands have up to `most_rows` luxel
    /// rows. Starts to copy on `queue`.
    /// @throws What Film throws of filter and layers; what the backend throws.
    BackendFilm(const B& backend, Queue& queue, const LuxelGrid& grid, const Filter& filter,
                std::uint64_t seed, std::uint32_t layers, std::uint32_t most_rows)
        : backend_(backend),
          grid_(grid),
          seed_(seed),
          layers_(layers),
          most_rows_(most_rows),
          taps_(grid, filter),
          curves_(backend, queue, taps_.curves()),
          ranges_(backend, queue, taps_.ranges()),
          ring_(std::min(grid.pixels.height, most_rows / grid.per_pixel_y + 2 * taps_.reach() + 1)),
          sums_(backend.template buffer<double>(std::size_t{1 + 3 * layers} * ring_ *
                                                grid.pixels.width)) {
        queue.clear(sums_);
        for (std::uint32_t l = 0; l < layers; ++l)
            images_.push_back(Image<Rgb>::unwritten(grid.pixels));
    }

    /// Adds a band of complete luxel rows and develops finished pixels. Radiance is in W m^-2
    /// sr^-1, a layer for each of the film's; no later band reaches a finished pixel. Bands come
    /// from top to bottom without gaps. All work is done when it returns.
    /// @throws Error(invalid_argument) when band or layers do not fit; what the backend throws,
    ///         after which no band fits any more.
    void add_rows(Queue& queue, std::uint32_t first_row, std::vector<BackendLayer<B>>& layers);

    /// What another film needs to go on below the rows added so far (Film::seam()).
    /// @throws Error(invalid_argument) when an error ended add_rows(); what the backend throws.
    [[nodiscard]] FilmSeam seam(Queue& queue);

    /// Goes on below another film, of the host or of another machine (Film::go_on()). Only pixels
    /// from there on mean anything.
    /// @throws Error(invalid_argument) when the seam does not fit, or pixels are not at home; what
    ///         the backend throws.
    void go_on(Queue& queue, const FilmSeam& seam);

    /// Rows of luxels added so far. Those above the seam that it went on from count.
    [[nodiscard]] std::uint32_t rows() const { return luxel_rows_; }

    /// Copies what was developed last to the images.
    template <Executor E>
    void bring_home(Queue& queue, E& executor);

    /// The images of the layers, as far as bands were added and brought home.
    [[nodiscard]] const std::vector<Image<Rgb>>& images() const { return images_; }

    /// The images of the layers, once all bands were added and brought home. Leaves the film
    /// without.
    [[nodiscard]] std::vector<Image<Rgb>> take_images() { return std::move(images_); }

 private:
    [[nodiscard]] FilmSums sums() { return {sums_.data(), grid_.pixels.width, ring_, layers_}; }
    [[nodiscard]] detail::TapView taps() const {
        detail::TapView view = taps_.view();
        view.curves = view.curves == nullptr ? nullptr : curves_.data();
        view.ranges = ranges_.data();
        return view;
    }
    void develop(Queue& queue, std::uint32_t end);

    B backend_;
    LuxelGrid grid_;
    std::uint64_t seed_;
    std::uint32_t layers_;
    std::uint32_t most_rows_;  ///< of luxels in a band
    detail::TapTable taps_;
    UploadedArray<B, float> curves_;
    UploadedArray<B, detail::TapRange> ranges_;
    std::uint32_t ring_;  ///< rows of pixels
    typename B::template Buffer<double> sums_;
    std::uint32_t luxel_rows_ = 0;  ///< added
    bool in_part_ = false;          ///< a band is being added, or an error ended that
    std::uint32_t home_ = 0;        ///< rows of pixels in the images
    std::uint32_t developed_ = 0;   ///< rows of pixels, those included
    std::optional<typename B::template Buffer<Rgb>> pixels_;
    std::vector<Image<Rgb>> images_;
};

template <Backend B>
void BackendFilm<B>::add_rows(Queue& queue, std::uint32_t first_row,
                              std::vector<BackendLayer<B>>& layers) {
    const Extent whole = grid_.luxels();
    expects(
        layers.size() == layers_ && first_row == luxel_rows_ && home_ == developed_ && !in_part_,
        "a band was added to a film whose layers or rows it does not continue, or that has "
        "part of a band since an error; add bands from top to bottom, with all layers, and "
        "bring each home");
    const Extent band = layers.front().grid().image;
    expects(band.width == whole.width && band.height <= whole.height - first_row &&
                band.height <= most_rows_,
            "a band does not fit into the image of its film, or is higher than the film was told; "
            "add as many rows of that image");
    std::vector<LayerView> views;
    for (const BackendLayer<B>& layer : layers) views.push_back(layer.view());
    const UploadedArray<B, LayerView> there(backend_, queue, views);
    auto offsets = backend_.template buffer<Vec2>(static_cast<std::size_t>(band.area()));
    const WaitAtEnd wait(queue);
    in_part_ = true;
    queue.for_each(static_cast<std::uint32_t>(band.area()),
                   LuxelOffsets{grid_, seed_, first_row, offsets.data()});
    luxel_rows_ = first_row + band.height;
    const std::uint32_t above = first_row / grid_.per_pixel_y;
    const std::uint32_t begin = above - std::min(above, taps_.reach());
    const std::uint32_t end =
        std::min(grid_.pixels.height, (luxel_rows_ - 1) / grid_.per_pixel_y + taps_.reach() + 1);
    queue.for_each((end - begin) * grid_.pixels.width,
                   FilmPass<LayerView>{grid_, taps(), offsets.data(), there.data(), sums(),
                                       first_row, band.height, begin});
    develop(queue, FilmSeam::below(luxel_rows_, grid_, taps_.reach()).first_row);
    queue.record().sync();
    in_part_ = false;
}

template <Backend B>
void BackendFilm<B>::develop(Queue& queue, std::uint32_t end) {
    const std::uint32_t rows = end - developed_;
    const std::size_t count = std::size_t{rows} * grid_.pixels.width;
    pixels_.emplace(backend_.template buffer<Rgb>(count * layers_));
    queue.for_each(static_cast<std::uint32_t>(count),
                   DevelopPass{sums(), grid_.per_pixel(), developed_, rows, pixels_->data()});
    developed_ = end;
}

template <Backend B>
FilmSeam BackendFilm<B>::seam(Queue& queue) {
    expects(!in_part_,
            "a film was left that has part of a band since an error (its sums are of nothing); "
            "make a new film and add all bands again");
    FilmSeam seam = FilmSeam::below(luxel_rows_, grid_, taps_.reach());
    seam.sums.resize(seam.count(grid_, sums().planes()));
    auto there = backend_.template buffer<double>(seam.sums.size());
    const WaitAtEnd wait(queue);
    queue.for_each(seam.rows * grid_.pixels.width,
                   LeaveSeam{sums(), seam.first_row, seam.rows, there.data()});
    queue.download(there, std::span(seam.sums));
    queue.record().sync();
    return seam;
}

template <Backend B>
void BackendFilm<B>::go_on(Queue& queue, const FilmSeam& seam) {
    check_seam(seam, grid_, taps_.reach(), sums().planes(), luxel_rows_);
    expects(home_ == developed_ && !in_part_,
            "a film was to go on elsewhere that has pixels which are not at home, or part of a "
            "band since an error; bring each band home");
    const UploadedArray<B, double> there(backend_, queue, seam.sums);
    const WaitAtEnd wait(queue);
    queue.clear(sums_);
    queue.for_each(seam.rows * grid_.pixels.width,
                   EnterSeam{sums(), seam.first_row, seam.rows, there.data()});
    queue.record().sync();
    luxel_rows_ = seam.luxel_rows;
    developed_ = home_ = seam.first_row;
}

template <Backend B>
template <Executor E>
void BackendFilm<B>::bring_home(Queue& queue, E& executor) {
    const std::uint32_t rows = developed_ - home_;
    if (rows == 0) return;
    const std::size_t width = grid_.pixels.width;
    bring_rows(backend_, queue, executor, std::as_const(*pixels_).data(),
               std::size_t{rows} * layers_, width, [&](std::size_t i, std::span<const Rgb> row) {
                   std::copy(row.begin(), row.end(),
                             images_[i / rows].pixels().begin() + (home_ + i % rows) * width);
               });
    pixels_.reset();
    home_ = developed_;
}

}  // namespace mir
