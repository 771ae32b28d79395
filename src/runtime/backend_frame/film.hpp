// SPDX-License-Identifier: MIT
#pragma once

// Members of BackendFrame that make pixels of luxels.

#include "mir/resident/wait_at_end.hpp"
#include "runtime/backend_frame.hpp"
#include "runtime/seam_above.hpp"

namespace mir {

template <Backend M, Bsdf B>
void BackendFrame<M, B>::add(FrameLayer& sum, const FrameLayer& layer) {
    const auto luxels = static_cast<std::uint32_t>(of(sum).grid().size());
    queue_.for_each(luxels,
                    AddLayer{{of(sum).words().data(), luxels}, {of(layer).view().words, luxels}});
    queue_.record().sync();
}

template <Backend M, Bsdf B>
std::vector<double> BackendFrame<M, B>::row_luminances(const FrameLayer& layer) {
    const std::uint32_t rows = of(layer).grid().image.height;
    auto sums = machine_.template buffer<double>(rows);
    std::vector<double> here(rows);
    const WaitAtEnd wait(queue_);
    queue_.for_each(rows, RowLuminance{of(layer).view(), sums.data()});
    queue_.download(sums, std::span(here));
    queue_.record().sync();
    return here;
}

template <Backend M, Bsdf B>
void BackendFrame<M, B>::put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) {
    FilmSeam* const seam = turn.seam();
    std::vector<BackendLayer<M>> images;
    for (const LayerPtr& layer : layers) images.push_back(std::move(of(*layer)));
    {
        const auto stage = job_.clock.measure(&StageSeconds::film);
        if (!picture_)
            picture_.emplace(
                Picture{{machine_, queue_, job_.rays.grid, job_.settings.filter, job_.rays.seed,
                         static_cast<std::uint32_t>(images.size()), band.extent().height},
                        {machine_, job_.rays.grid, job_.rays.camera}});
        if (picture_->film.rows() != band.first_row)
            picture_->film.go_on(queue_, seam_above(job_, band.first_row, images.size(), seam));
        picture_->film.add_rows(queue_, band.first_row, images);
        if (seam != nullptr) *seam = picture_->film.seam(queue_);
        if (job_.layers.empty())
            for (std::size_t l = 0; l < images.size(); ++l)
                job_.layers.push_back(Image<Rgb>::unwritten(job_.rays.grid.pixels));
    }
    turn.pass();
    {
        const auto stage = job_.clock.measure(&StageSeconds::guides);
        picture_->guides.template add<B>(queue_, of(band).gbuffer, band.first_row);
    }
    const auto stage = job_.clock.measure(&StageSeconds::download);
    picture_->film.bring_home(queue_, job_.threads, job_.layers);
    picture_->guides.bring_home(queue_, job_.threads, job_.result.guides);
}

template <Backend M, Bsdf B>
std::vector<Image<Rgb>> BackendFrame<M, B>::develop() {
    picture_.reset();
    return std::exchange(job_.layers, {});
}

template <Backend M, Bsdf B>
void BackendFrame<M, B>::develop_rows(std::uint32_t first, std::uint32_t end,
                                      std::vector<Image<Rgb>>& images) {
    if (images.empty()) images.resize(job_.layers.size(), Image<Rgb>(job_.settings.image));
    for (std::size_t l = 0; l < images.size(); ++l) {
        const std::span<const Rgb> from = job_.layers[l].pixels();
        const std::size_t width = job_.layers[l].width();
        std::copy(from.begin() + first * width, from.begin() + end * width,
                  images[l].pixels().begin() + first * width);
    }
}

}  // namespace mir
