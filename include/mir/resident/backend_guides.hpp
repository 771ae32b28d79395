// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/guides.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/resident/bring_rows.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace mir {

/// Guides of luxels that lie in a backend's memory, with the bits of add_guides(). One queue and
/// one thread at a time.
template <Backend B>
class BackendGuides {
 public:
    /// Of the backend.
    using Queue = typename B::Queue;

    /// Guides of an image as `camera` sees it.
    BackendGuides(const B& backend, const LuxelGrid& grid, const Camera& camera)
        : backend_(backend), grid_(grid), lens_{camera.position, camera.back} {}

    /// Makes the guides of a band of whole pixel rows. It starts at luxel row `first_row`. All work
    /// is done when it returns. Each band must be brought home before the next.
    template <Bsdf F>
    void add(Queue& queue, const BackendGBuffer<B, typename F::Params>& luxels,
             std::uint32_t first_row) {
        first_row_ = first_row / grid_.per_pixel_y;
        rows_ = luxels.extent().height / grid_.per_pixel_y;
        const std::size_t count = std::size_t{rows_} * grid_.pixels.width;
        there_.emplace(backend_, count);
        queue.for_each(static_cast<std::uint32_t>(count),
                       GuidePass<F, LuxelImageView<typename F::Params>>{
                           luxels.image(), grid_, lens_, there_->albedo.data(),
                           there_->normal.data(), there_->position.data(), there_->depth.data()});
        queue.record().sync();
    }

    /// Copies the guides of the last band to the images.
    template <Executor E>
    void bring_home(Queue& queue, E& executor, Guides& guides) {
        bring_home(queue, executor, there_->albedo, guides.albedo);
        bring_home(queue, executor, there_->normal, guides.normal);
        bring_home(queue, executor, there_->position, guides.position);
        bring_home(queue, executor, there_->depth, guides.depth);
        there_.reset();
    }

 private:
    template <class T>
    using Buffer = typename B::template Buffer<T>;

    struct Arrays {
        Arrays(const B& backend, std::size_t count)
            : albedo(backend.template buffer<Rgb>(count)),
              normal(backend.template buffer<Vec3>(count)),
              position(backend.template buffer<Vec3>(count)),
              depth(backend.template buffer<float>(count)) {}

        Buffer<Rgb> albedo;
        Buffer<Vec3> normal;
        Buffer<Vec3> position;
        Buffer<float> depth;
    };

    template <Executor E, class T>
    void bring_home(Queue& queue, E& executor, const Buffer<T>& from, Image<T>& to) {
        const std::size_t width = grid_.pixels.width;
        bring_rows(backend_, queue, executor, from.data(), rows_, width,
                   [&](std::size_t i, std::span<const T> row) {
                       std::copy(row.begin(), row.end(),
                                 to.pixels().begin() + (first_row_ + i) * width);
                   });
    }

    B backend_;
    LuxelGrid grid_;
    LensPlane lens_;
    std::uint32_t first_row_ = 0;  ///< of pixels in the last band
    std::uint32_t rows_ = 0;       ///< of pixels in the last band
    std::optional<Arrays> there_;
};

}  // namespace mir
