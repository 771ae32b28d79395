// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/shading_pass.hpp"
#include "mir/kernels/word_shading.hpp"
#include "mir/reconstruct.hpp"
#include "mir/resident/uploaded_vpls.hpp"
#include "mir/resident/word_finder.hpp"
#include "mir/sched/detail/tile_ring.hpp"

namespace mir::sched {

/// RCVP, figure 6 of the paper: per tile, kernels of rays or shafts (WordFinder) that need the hits
/// alone, and behind them one of shading; the surfaces go up while rays are traced. Given a
/// KnownVisibility the first kernel is left out. On the host the image is that of sched::Cpu in
/// every bit. Not thread-safe; several may share a backend.
template <Backend B>
struct ReconstructVisibilityParallel {
    B backend;                   ///< where luxels are lit
    Monitor* monitor = nullptr;  ///< may be null

    /// Model of mir::Pipeline for one image; what it is given must outlive it.
    template <class In>
    class Pipeline {
     public:
        /// Takes memory of the backend for up to three tiles and starts to copy the VPLs.
        /// @throws What the backend throws when it has no memory left.
        Pipeline(const In& in, Image<Rgb>& image, const ReconstructVisibilityParallel& scheduler)
            : in_(in),
              vpls_(scheduler.backend, in.vpls),
              ring_(scheduler.backend, in.gbuffer, vpls_.size(),
                    is_known ? detail::SlotVisibility::masks : detail::SlotVisibility::words, image,
                    scheduler.monitor),
              finder_(scheduler.backend, ring_.largest_tile(), vpls_.size()),
              copy_(scheduler.backend.queue()),
              compute_(scheduler.backend.queue()),
              home_(scheduler.backend.queue()) {
            vpls_.send(copy_);
        }

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
                compute_.for_each(slot.luxels,
                                  ShadingPass{ring_.luxels(slot), vpls_.view(),
                                              slot.known(vpls_.size()), in_.shading, slot.sums()});
            else
                compute_.for_each_group(slot.luxels / LaneGroup::width,
                                        WordShading{ring_.luxels(slot), vpls_.view(),
                                                    slot.words.data(), in_.shading, slot.sums()});
            ring_.send_back(slot, compute_, home_);
        }
        /// Waits for the tiles that are still on their way and writes them to the image.
        /// @throws What the backend throws when its work failed.
        void finish() { ring_.drain(); }

     private:
        using G = std::remove_cvref_t<decltype(std::declval<In>().gbuffer)>;
        static constexpr bool is_known = KnownVisibility<decltype(In::visibility)>;

        const In& in_;
        UploadedVpls<B> vpls_;
        detail::TileRing<B, G> ring_;
        WordFinder<B> finder_;
        // Last, so that they end, and wait for their work, before the memory goes.
        typename B::Queue copy_;
        typename B::Queue compute_;
        typename B::Queue home_;
    };

    /// A pipeline for one image, whose size is that of the G-buffer.
    template <class In>
    Pipeline<In> open(const In& in, Image<Rgb>& image) const {
        detail::check_pairing<In, B>();
        return {in, image, *this};
    }
};
template <Backend B>
ReconstructVisibilityParallel(B) -> ReconstructVisibilityParallel<B>;
template <Backend B>
ReconstructVisibilityParallel(B, Monitor*) -> ReconstructVisibilityParallel<B>;

}  // namespace mir::sched
