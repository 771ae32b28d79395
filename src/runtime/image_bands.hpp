// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

#include <cstdint>

namespace mir {

/// Cuts the luxels of an image into bands of rows for frames. So memory does not grow with the
/// image. Bands never cut blocks or pixels: nothing but memory depends on them, and
/// how much of it several frames have to do.
class ImageBands {
 public:
    /// `vpls`: number of VPLs whose visibility will be stored, 0 for none. Bands become lower until
    /// the matrix of one fits into Limits::visibility_bytes. `frame` is the whole one.
    ImageBands(const RenderFrame& frame, std::uint32_t vpls)
        : ImageBands(frame, vpls, frame.job().rays.grid.luxels().height) {}

    /// Those that pixels of RenderSettings::rows are made of alone: the same blocks of luxels.
    [[nodiscard]] static ImageBands of_rows(const RenderFrame& frame, std::uint32_t vpls);

    /// Bands that the rows are cut into; the last may be lower than the others.
    [[nodiscard]] std::uint32_t count() const { return (end_ - first_ + rows_ - 1) / rows_; }

    /// Luxels of the whole image.
    [[nodiscard]] Extent luxels() const { return frame_.job().rays.grid.luxels(); }

    /// First row of luxels of the first band.
    [[nodiscard]] std::uint32_t first_row() const { return first_; }
    /// Row of luxels behind those of the last band.
    [[nodiscard]] std::uint32_t end_row() const { return end_; }
    /// Luxels of all bands together, as a share of the image.
    [[nodiscard]] double share() const {
        return static_cast<double>(end_ - first_) / static_cast<double>(luxels().height);
    }

    /// Has `by` trace the camera rays of band `i`. It is the frame or a part of it.
    [[nodiscard]] BandPtr make(RenderFrame& by, std::uint32_t i) const;

    /// True when all bands with their visibility of `vpls` VPLs fit into Limits::visibility_bytes.
    [[nodiscard]] bool fit_together(std::uint32_t vpls) const;

 private:
    ImageBands(const RenderFrame& frame, std::uint32_t vpls, std::uint32_t end,
               std::uint32_t first = 0);

    [[nodiscard]] std::uint32_t choose_rows(std::uint32_t vpls) const;
    [[nodiscard]] std::uint64_t matrix_bytes(std::uint32_t vpls) const;

    const RenderFrame& frame_;
    Extent tile_;
    std::uint32_t first_;  ///< row of luxels
    std::uint32_t end_;    ///< behind the last one
    std::uint32_t rows_;   ///< of a band
};

/// Has the frame that made a band trace its shadow rays, in their stage.
/// @throws Error(limit_exceeded) when the bits do not fit into Limits::visibility_bytes.
void find_visible(RenderFrame& by, FrameBand& band, VplSpan<Space::host> vpls);

}  // namespace mir
