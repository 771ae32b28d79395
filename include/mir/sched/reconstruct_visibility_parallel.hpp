// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/word_shading.hpp"
#include "mir/reconstruct.hpp"
#include "mir/resident/word_finder.hpp"
#include "mir/sched/detail/tile_pipeline.hpp"

namespace mir::sched {

/// RCVP, figure 6 of the paper: per tile, kernels of rays, then one of shading. Rays or shafts
/// (WordFinder) need the hits alone; the surfaces go up meanwhile. Given a KnownVisibility the
/// first kernel is left out. On the host the image is that of sched::Cpu in every bit. Not
/// thread-safe; several may share a backend.
template <Backend B>
struct ReconstructVisibilityParallel {
    B backend;                   ///< where luxels are lit
    Monitor* monitor = nullptr;  ///< may be null

    /// Model of mir::Pipeline for one image; what it is given must outlive it.
    template <class In>
    class Pipeline : public detail::TilePipeline<B, In, WordFinder<B>> {
        using Base = detail::TilePipeline<B, In, WordFinder<B>>;

     public:
        using Base::Base;

        /// Starts a tile's work. Waits for the third tile before, which it writes to the image.
        /// @throws Error(cancelled) when the monitor asks to stop; what the backend throws.
        void submit(TileIndex t) {
            auto& slot = ring_.acquire(t);
            ring_.upload_hits(slot, copy_);
            const auto hits_there = copy_.record();
            if constexpr (is_known) ring_.upload_known(slot, copy_, in_.visibility);
            ring_.upload_surfaces(slot, copy_);  // hidden behind the rays below
            const auto surfaces_there = copy_.record();

            compute_.wait(hits_there);
            if constexpr (!is_known)
                finder_.find(compute_, ring_.luxels(slot),
                             BlockedLayout::of(in_.gbuffer.tiles()[t]), vpls_.view(),
                             in_.visibility, slot.words.data());
            compute_.wait(surfaces_there);
            if constexpr (is_known)
                Base::shade_known(slot);
            else
                compute_.for_each_group(slot.luxels / LaneGroup::width,
                                        WordShading{ring_.luxels(slot), vpls_.view(),
                                                    slot.words.data(), in_.shading, slot.sums()});
            ring_.send_back(slot, compute_, home_);
        }

     private:
        using Base::copy_, Base::compute_, Base::home_;
        using Base::is_known, Base::in_, Base::vpls_, Base::ring_, Base::finder_;
    };

    /// A pipeline for one image, whose size is that of the G-buffer.
    template <class In>
    Pipeline<In> open(const In& in, Image<Rgb>& image) const {
        detail::check_pairing<In, B>();
        return {in, image, backend, monitor};
    }
};
template <Backend B>
ReconstructVisibilityParallel(B) -> ReconstructVisibilityParallel<B>;
template <Backend B>
ReconstructVisibilityParallel(B, Monitor*) -> ReconstructVisibilityParallel<B>;

}  // namespace mir::sched
