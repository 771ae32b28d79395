// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/fused.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/detail/tile_pipeline.hpp"

namespace mir::sched {

/// RC, figure 5 of the paper: one kernel per tile for everything. It traces, shades and sums, while
/// the next tile goes up and the last one comes home. Given a KnownVisibility it traces no ray. On
/// the host the image is that of sched::Cpu in every bit. Not thread-safe; several may share a
/// backend.
template <Backend B>
struct Reconstruct {
    B backend;                   ///< where luxels are lit
    Monitor* monitor = nullptr;  ///< may be null

    /// Model of mir::Pipeline for one image; what it is given must outlive it.
    template <class In>
    class Pipeline : public detail::TilePipeline<B, In> {
        using Base = detail::TilePipeline<B, In>;

     public:
        using Base::Base;

        /// Starts a tile's work. Waits for the third tile before, which it writes to the image.
        /// @throws Error(cancelled) when the monitor asks to stop; what the backend throws.
        void submit(TileIndex t) {
            auto& slot = ring_.acquire(t);
            ring_.upload_hits(slot, copy_);
            ring_.upload_surfaces(slot, copy_);
            if constexpr (is_known) ring_.upload_known(slot, copy_, in_.visibility);
            compute_.wait(copy_.record());
            if constexpr (is_known)
                Base::shade_known(slot);
            else
                compute_.for_each(slot.luxels,
                                  FusedKernel{ring_.luxels(slot), vpls_.view(), in_.visibility,
                                              in_.shading, slot.sums()});
            ring_.send_back(slot, compute_, home_);
        }

     private:
        using Base::copy_, Base::compute_, Base::home_;
        using Base::is_known, Base::in_, Base::vpls_, Base::ring_;
    };

    /// A pipeline for one image, whose size is that of the G-buffer.
    template <class In>
    Pipeline<In> open(const In& in, Image<Rgb>& image) const {
        detail::check_pairing<In, B>();
        return {in, image, backend, monitor};
    }
};
template <Backend B>
Reconstruct(B) -> Reconstruct<B>;
template <Backend B>
Reconstruct(B, Monitor*) -> Reconstruct<B>;

}  // namespace mir::sched
