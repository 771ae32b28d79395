// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/data/image.hpp"
#include "mir/data/soa.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/sched/detail/check_pairing.hpp"
#include "mir/sched/detail/write_tile.hpp"

#include <optional>
#include <vector>

namespace mir::sched::detail {

/// What one tile needs on a backend. Buffers are as large as the largest tile asks for.
template <Backend B>
struct TileSlot {
    TileIndex tile = 0;
    std::uint32_t luxels = 0;  ///< padding included
    typename B::template Buffer<std::uint32_t> hits;
    typename B::template Buffer<std::uint32_t> surfaces;
    typename B::template Buffer<std::uint32_t> radiance;
    typename B::template Buffer<std::uint32_t> words;        ///< visibility found here
    typename B::template Buffer<std::uint16_t> masks;        ///< visibility known before
    typename B::template HostBuffer<std::uint32_t> at_home;  ///< radiance on the host
    std::optional<typename B::Event> done = std::nullopt;    ///< radiance is at home

    [[nodiscard]] SoaView<Rgb> sums() { return {radiance.data(), luxels}; }
    [[nodiscard]] TileMasks<B::space> known(std::uint32_t vpls) const {
        return {masks.data(), vpls};
    }
};

/// What kinds of visibility the slots of a ring hold.
enum class SlotVisibility { none, words, masks };

/// A few tiles on their way. While one is computed, the next goes up and the last comes home. Slots
/// are used in turn; acquire() waits for the tile that used a slot last and writes it into the
/// image. Not thread-safe.
template <Backend B, class G>
class TileRing {
 public:
    using Slot = TileSlot<B>;
    using View = typename ViewOf<G>::template In<B::space>;

    TileRing(const B& backend, const G& gbuffer, std::uint32_t vpls, SlotVisibility visibility,
             Image<Rgb>& image, Monitor* monitor)
        : gbuffer_(gbuffer), vpls_(vpls), image_(image), monitor_(monitor) {
        const std::size_t count = std::min<std::size_t>(depth, gbuffer.tiles().size());
        for (std::size_t i = 0; i < count; ++i) slots_.push_back(make_slot(backend, visibility));
    }

    /// Luxels of the largest tile, padding included.
    [[nodiscard]] std::uint32_t largest_tile() const {
        std::uint32_t most = 0;
        for (const Tile& t : gbuffer_.tiles()) most = std::max(most, BlockedLayout::of(t).size());
        return most;
    }

    /// The slot for a tile, once the tile before it has left.
    /// @throws Error(cancelled) when the caller asked to stop.
    Slot& acquire(TileIndex t) {
        if (monitor_ != nullptr) monitor_->check();
        Slot& slot = slots_[next_];
        next_ = (next_ + 1) % slots_.size();
        bring_home(slot);
        slot.tile = t;
        slot.luxels = BlockedLayout::of(gbuffer_.tiles()[t]).size();
        return slot;
    }

    void upload_hits(Slot& slot, typename B::Queue& queue) {
        if constexpr (!ResidentGBuffer<G, B>)
            queue.upload(gbuffer_.hit_words_of(slot.tile), slot.hits);
    }
    void upload_surfaces(Slot& slot, typename B::Queue& queue) {
        if constexpr (!ResidentGBuffer<G, B>)
            queue.upload(gbuffer_.surface_words_of(slot.tile), slot.surfaces);
    }
    void upload_known(Slot& slot, typename B::Queue& queue,
                      const VisibilityBits<Space::host>& bits) {
        const TileMasks<Space::host> masks = bits.tile(slot.tile);
        queue.upload(std::span(masks.masks, TileMasks<Space::host>::count(slot.luxels, vpls_)),
                     slot.masks);
    }

    /// The luxels of the slot's tile where the backend can read them.
    [[nodiscard]] View luxels(const Slot& slot) const {
        if constexpr (ResidentGBuffer<G, B>)
            return gbuffer_.view(slot.tile);
        else
            return {{slot.hits.data(), slot.luxels}, {slot.surfaces.data(), slot.luxels}};
    }

    /// Starts the way home by the queue `home`. The next tile's kernels do not wait for it; what
    /// was given to `compute` before is done by then.
    void send_back(Slot& slot, typename B::Queue& compute, typename B::Queue& home) {
        home.wait(compute.record());
        home.download(slot.radiance, slot.at_home.span().first(words<Rgb>(slot.luxels)));
        slot.done = home.record();
    }

    /// Waits for every tile and writes it into the image.
    void drain() {
        for (std::size_t i = 0; i < slots_.size(); ++i)
            bring_home(slots_[(next_ + i) % slots_.size()]);
    }

 private:
    static constexpr std::size_t depth = 3;

    template <class T>
    static constexpr std::size_t words(std::uint32_t luxels) {
        return std::size_t{SoaView<T>::words} * luxels;
    }

    [[nodiscard]] Slot make_slot(const B& backend, SlotVisibility visibility) const {
        const std::uint32_t most = largest_tile();
        const bool copies = !ResidentGBuffer<G, B>;
        const auto if_wanted = [](bool wanted, std::size_t n) { return wanted ? n : 0; };
        const auto word_buffer = [&](std::size_t n) {
            return backend.template buffer<std::uint32_t>(n);
        };
        return {0,
                0,
                word_buffer(if_wanted(copies, words<Hit>(most))),
                word_buffer(if_wanted(copies, words<typename View::Surface>(most))),
                word_buffer(words<Rgb>(most)),
                word_buffer(if_wanted(visibility == SlotVisibility::words,
                                      VisibilityWords<B::space>::count(most, vpls_))),
                backend.template buffer<std::uint16_t>(if_wanted(
                    visibility == SlotVisibility::masks, TileMasks<B::space>::count(most, vpls_))),
                backend.template host_buffer<std::uint32_t>(words<Rgb>(most))};
    }

    void bring_home(Slot& slot) {
        if (!slot.done) return;
        slot.done->sync();
        slot.done.reset();
        const Tile tile = gbuffer_.tiles()[slot.tile];
        const SoaView<const Rgb> radiance{slot.at_home.span().data(), slot.luxels};
        write_tile(image_, tile, [&](LuxelIndex i) { return radiance.load(i); });
        if (monitor_ != nullptr)
            monitor_->contributions += std::uint64_t{tile.width} * tile.height * vpls_;
    }

    const G& gbuffer_;
    std::uint32_t vpls_;
    Image<Rgb>& image_;
    Monitor* monitor_;
    std::vector<Slot> slots_;
    std::size_t next_ = 0;
};

}  // namespace mir::sched::detail
