// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/block_list.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/kernels/shade_one_vpl.hpp"
#include "mir/reconstruct.hpp"
#include "mir/resident/uploaded_vpls.hpp"
#include "mir/sched/detail/tile_ring.hpp"

#include <array>

namespace mir::sched {

/// OS, figure 3 of the paper: the backend shades while the host traces. Per tile and VPL the
/// backend shades every luxel, and the host adds up. One plane of radiance comes home per VPL,
/// which the paper found too slow. The image is that of sched::Cpu in every bit if the backend's
/// arithmetic is the host's. Not thread-safe; several may share a backend.
template <Backend B, Executor E>
struct ShadingOnly {
    B backend;                   ///< where luxels are shaded
    E& executor;                 ///< traces and adds
    Monitor* monitor = nullptr;  ///< may be null

    /// Model of mir::Pipeline for one image; what it is given must outlive it.
    template <class In>
    class Pipeline {
     public:
        /// Allocates tiles and two planes of radiance on the backend, and starts to copy
        /// VPLs.
        /// @throws What the backend throws when it has no memory left.
        Pipeline(const In& in, Image<Rgb>& image, const ShadingOnly& scheduler);

        /// Computes the tile and writes it to the image before it returns.
        /// @throws Error(cancelled) when the monitor asks to stop; what the backend throws.
        void submit(TileIndex t);
        /// Nothing is left to do.
        void finish() {}

     private:
        using G = std::remove_cvref_t<decltype(std::declval<In>().gbuffer)>;
        using Slot = detail::TileSlot<B>;

        /// Radiance of one VPL: on the backend and, once `done`, on the host.
        struct Plane {
            typename B::template Buffer<std::uint32_t> there;
            typename B::template HostBuffer<std::uint32_t> at_home;
            std::optional<typename B::Event> done = std::nullopt;
        };

        [[nodiscard]] static Plane make_plane(const B& backend, const G& gbuffer);
        void shade_ahead(const Slot& slot, VplIndex j);
        void trace(const Slot& slot, VplIndex j);
        void add_where_seen(const Slot& slot, VplIndex j);
        void write(const Slot& slot);
        template <class Body>
        void for_each_luxel(const Slot& slot, const Body& body) const;

        const In& in_;
        Image<Rgb>& image_;
        const ShadingOnly& scheduler_;
        UploadedVpls<B> vpls_;
        detail::TileRing<B, G> ring_;
        std::array<Plane, 2> planes_;
        std::vector<std::uint8_t> seen_;
        std::vector<Rgb> sums_;
        // Last, so that they end, and wait for their work, before the memory goes.
        typename B::Queue copy_;
        typename B::Queue compute_;
        typename B::Queue home_;
    };

    /// A pipeline for one image, whose size is that of the G-buffer. It refers to this scheduler.
    template <class In>
    Pipeline<In> open(const In& in, Image<Rgb>& image) const {
        static_assert(AccessibleFrom<decltype(in.visibility), Space::host>,
                      "mir: sched::ShadingOnly traces on the host and needs a Visibility there; "
                      "give one, or use sched::Reconstruct");
        static_assert(PackedGBuffer<std::remove_cvref_t<decltype(in.gbuffer)>>,
                      "mir: sched::ShadingOnly needs a G-buffer in words on the host, such as "
                      "BlockedGBuffer");
        return {in, image, *this};
    }
};
template <Backend B, Executor E>
ShadingOnly(B, E&) -> ShadingOnly<B, E>;
template <Backend B, Executor E>
ShadingOnly(B, E&, Monitor*) -> ShadingOnly<B, E>;

template <Backend B, Executor E>
template <class In>
ShadingOnly<B, E>::Pipeline<In>::Pipeline(const In& in, Image<Rgb>& image,
                                          const ShadingOnly& scheduler)
    : in_(in),
      image_(image),
      scheduler_(scheduler),
      vpls_(scheduler.backend, in.vpls),
      ring_(scheduler.backend, in.gbuffer, vpls_.size(), detail::SlotVisibility::none, image,
            scheduler.monitor),
      planes_{make_plane(scheduler.backend, in.gbuffer), make_plane(scheduler.backend, in.gbuffer)},
      copy_(scheduler.backend.queue()),
      compute_(scheduler.backend.queue()),
      home_(scheduler.backend.queue()) {
    vpls_.send(copy_);
}

template <Backend B, Executor E>
template <class In>
auto ShadingOnly<B, E>::Pipeline<In>::make_plane(const B& backend, const G& gbuffer) -> Plane {
    std::size_t words = 0;
    for (const Tile& t : gbuffer.tiles())
        words = std::max<std::size_t>(
            words, std::size_t{SoaView<Rgb>::words} * BlockedLayout::of(t).size());
    return {backend.template buffer<std::uint32_t>(words),
            backend.template host_buffer<std::uint32_t>(words)};
}

template <Backend B, Executor E>
template <class In>
void ShadingOnly<B, E>::Pipeline<In>::submit(TileIndex t) {
    Slot& slot = ring_.acquire(t);
    ring_.upload_hits(slot, copy_);
    ring_.upload_surfaces(slot, copy_);
    compute_.wait(copy_.record());
    sums_.assign(slot.luxels, {});
    seen_.resize(slot.luxels);
    if (vpls_.size() > 0) shade_ahead(slot, 0);
    for (VplIndex j = 0; j < vpls_.size(); ++j) {
        if (j + 1 < vpls_.size()) shade_ahead(slot, j + 1);  // the backend: next VPL
        trace(slot, j);                                      // the host: this VPL
        add_where_seen(slot, j);                             // after the plane came home
    }
    compute_.record().sync();
    write(slot);
}

template <Backend B, Executor E>
template <class In>
void ShadingOnly<B, E>::Pipeline<In>::shade_ahead(const Slot& slot, VplIndex j) {
    Plane& plane = planes_[j % 2];
    compute_.for_each(slot.luxels, ShadeOneVpl{ring_.luxels(slot), vpls_.view(), j, in_.shading,
                                               SoaView<Rgb>{plane.there.data(), slot.luxels}});
    const std::size_t words = std::size_t{SoaView<Rgb>::words} * slot.luxels;
    home_.wait(compute_.record());
    home_.download(plane.there, plane.at_home.span().first(words));
    plane.done = home_.record();
}

template <Backend B, Executor E>
template <class In>
void ShadingOnly<B, E>::Pipeline<In>::trace(const Slot& slot, VplIndex j) {
    if (scheduler_.monitor != nullptr) scheduler_.monitor->check();
    const auto luxels = in_.gbuffer.view(slot.tile);
    const Vpl vpl = vpls_.host_view()[j];
    for_each_luxel(slot, [&](LuxelIndex i) {
        if constexpr (KnownVisibility<decltype(In::visibility)>) {
            seen_[i] = in_.visibility.sees(slot.tile, i, j) ? 1 : 0;
        } else {
            const Hit hit = luxels.hit(i);
            const bool seen = !is_empty(hit) && faces(hit, vpl) &&
                              in_.visibility.visible(vpl.position, hit.position);
            seen_[i] = seen ? 1 : 0;
        }
    });
}

template <Backend B, Executor E>
template <class In>
void ShadingOnly<B, E>::Pipeline<In>::add_where_seen(const Slot& slot, VplIndex j) {
    Plane& plane = planes_[j % 2];
    plane.done->sync();
    const SoaView<const Rgb> shaded{plane.at_home.span().data(), slot.luxels};
    for_each_luxel(slot, [&](LuxelIndex i) {
        if (seen_[i] != 0) sums_[i] += shaded.load(i);
    });
}

template <Backend B, Executor E>
template <class In>
void ShadingOnly<B, E>::Pipeline<In>::write(const Slot& slot) {
    const Tile tile = in_.gbuffer.tiles()[slot.tile];
    detail::write_tile(image_, tile, [&](LuxelIndex i) { return sums_[i]; });
    if (scheduler_.monitor != nullptr)
        scheduler_.monitor->contributions += std::uint64_t{tile.width} * tile.height * vpls_.size();
}

/// Calls body(i) for every luxel of the slot's tile, block by block on the executor.
template <Backend B, Executor E>
template <class In>
template <class Body>
void ShadingOnly<B, E>::Pipeline<In>::for_each_luxel(const Slot& slot, const Body& body) const {
    scheduler_.executor.for_each(slot.luxels / BlockedLayout::block_size, [&](std::size_t block) {
        const auto first = static_cast<LuxelIndex>(block) * BlockedLayout::block_size;
        for (LuxelIndex i = first; i < first + BlockedLayout::block_size; ++i) body(i);
    });
}

}  // namespace mir::sched
