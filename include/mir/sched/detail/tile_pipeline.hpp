// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/shading_pass.hpp"
#include "mir/resident/uploaded_vpls.hpp"
#include "mir/sched/detail/tile_ring.hpp"

namespace mir::sched::detail {

/// Stands for a finder where the kernel of shading traces its rays itself.
template <Backend B>
struct NoFinder {
    NoFinder(const B& /*backend*/, std::uint32_t /*luxels*/, std::uint32_t /*vpls*/) {}
};

/// A pipeline without submit(). Its tiles are on their way in a TileRing; submit() of a derived
/// class says in which order. A `Finder` other than NoFinder fills words of visibility, for which
/// slots have room.
template <Backend B, class In, class Finder = NoFinder<B>>
class TilePipeline {
 public:
    /// Allocates up to three tiles on the backend and starts to copy VPLs.
    /// @throws What the backend throws when it has no memory left.
    TilePipeline(const In& in, Image<Rgb>& image, const B& backend, Monitor* monitor)
        : in_(in),
          vpls_(backend, in.vpls),
          ring_(backend, in.gbuffer, vpls_.size(), slot_visibility, image, monitor),
          finder_(backend, ring_.largest_tile(), vpls_.size()),
          copy_(backend.queue()),
          compute_(backend.queue()),
          home_(backend.queue()) {
        vpls_.send(copy_);
    }

    /// Waits for the tiles under way and writes them to the image.
    /// @throws What the backend throws when its work failed.
    void finish() { ring_.drain(); }

 protected:
    using G = std::remove_cvref_t<decltype(std::declval<In>().gbuffer)>;
    using Slot = TileSlot<B>;
    static constexpr bool is_known = KnownVisibility<decltype(In::visibility)>;

    /// Shades the luxels of a slot by bits that were found before.
    void shade_known(Slot& slot) {
        compute_.for_each(slot.luxels,
                          ShadingPass{ring_.luxels(slot), vpls_.view(), slot.known(vpls_.size()),
                                      in_.shading, slot.sums()});
    }

    const In& in_;
    UploadedVpls<B> vpls_;
    TileRing<B, G> ring_;
    Finder finder_;
    // Last, so that they end, and wait for their work, before the memory goes.
    typename B::Queue copy_;
    typename B::Queue compute_;
    typename B::Queue home_;

 private:
    static constexpr bool fills_words = !std::is_same_v<Finder, NoFinder<B>>;
    static constexpr SlotVisibility slot_visibility = is_known      ? SlotVisibility::masks
                                                      : fills_words ? SlotVisibility::words
                                                                    : SlotVisibility::none;
};

}  // namespace mir::sched::detail
