// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/block_list.hpp"
#include "mir/blocks/lit_vpls.hpp"
#include "mir/blocks/luxel_block.hpp"
#include "mir/blocks/page_sight.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/core/monitor.hpp"
#include "mir/reconstruct.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace mir::sched {

/// The tuned host path: blocks of 256 luxels outside, VPLs inside. Per block and VPL the facing
/// luxels are found and their rays traced; the lit ones of some VPLs are shaded together, a vector
/// register of luxels at a time. A BlockVisibility is asked page by page for 256
/// luxels, about some VPLs at a time; others for packets of sixteen rays that start at the VPL.
/// Same image as sched::Cpu in every bit where those faces give the bits of the single one,
/// provided that the caller compiles with -ffp-contract=off. Given a KnownVisibility it traces no
/// ray.
template <Executor E>
struct CpuBlocks {
    E& executor;                                           ///< runs blocks or pages
    Monitor* monitor = nullptr;                            ///< may be null
    InstructionSet instructions = best_instruction_set();  ///< of its loops; changes no bit

    /// Model of mir::Pipeline for one image; what it is given must outlive it.
    template <class In>
    class Pipeline {
     public:
        /// Reads `in` and writes the radiance of luxels, W m^-2 sr^-1, to `image`.
        Pipeline(const In& in, Image<Rgb>& image, const CpuBlocks& scheduler)
            : in_(in), image_(image), scheduler_(scheduler) {}

        /// Only notes the tile.
        void submit(TileIndex t) {
            if constexpr (by_pages)
                blocks::append_pages(parts_, t, in_.gbuffer.tiles()[t]);
            else
                blocks::append_blocks(parts_, t, in_.gbuffer.tiles()[t]);
        }

        /// Computes all tiles that were submitted, part by part on the executor.
        /// @throws Error(cancelled) when the monitor asks to stop.
        void finish() {
            scheduler_.executor.for_each(parts_.size(), [this](std::size_t i) {
                if (scheduler_.monitor != nullptr) scheduler_.monitor->check();
                run(parts_[i]);
            });
        }

     private:
        using F = decltype(In::shading);
        using V = std::remove_const_t<decltype(In::visibility)>;
        // Those that is_out_of_reach() reads.
        static constexpr bool wants_bounds = !KnownVisibility<V> || ReachLimitedShading<F>;
        using Hits = std::conditional_t<wants_bounds, blocks::BoundedHitBlock, blocks::HitBlock>;
        using LuxelBlock = blocks::LuxelBlock<F, Hits>;

        static constexpr bool by_pages = BlockVisibility<V> && !KnownVisibility<V>;
        using Part = std::conditional_t<by_pages, blocks::PlacedPage, blocks::Block>;

        /// A block of a page while VPLs are added to it.
        struct Work {
            blocks::Block place;
            LuxelBlock block;
            blocks::LitVpls batch{};
            blocks::GroupRadiance sums[blocks::groups_per_block]{};
        };

        void run(blocks::Block b) const;
        void run(const blocks::PlacedPage& page) const;
        template <InstructionSet Set>
        void run_page(const blocks::PlacedPage& page) const;
        template <InstructionSet Set>
        void shade(Work& work) const {
            work.batch.template shade<Set>(work.block, in_.shading, work.sums);
        }
        [[nodiscard]] std::vector<Work> start(const blocks::PlacedPage& page) const;
        template <InstructionSet Set, class FindLit>
        void add_vpls(const LuxelBlock& block, blocks::GroupRadiance* sums,
                      const FindLit& find_lit) const;
        void store(blocks::Block b, const blocks::GroupRadiance* sums) const;

        /// True when the VPL cannot reach any luxel of the block: skipping it loses nothing. Who
        /// faces it is not asked where masks that tell are at hand.
        [[nodiscard]] bool is_out_of_reach(const LuxelBlock& block, const Vpl& vpl) const {
            if (is_black(vpl.intensity)) return true;
            if constexpr (!KnownVisibility<V>)
                if (block.cannot_face(vpl)) return true;
            if constexpr (ReachLimitedShading<F>)
                return block.bounds.distance_squared(vpl.position) >
                       in_.shading.reach_squared() * (1.0f + 0x1p-16f);
            return false;
        }

        const In& in_;
        Image<Rgb>& image_;
        const CpuBlocks& scheduler_;
        std::vector<Part> parts_;
    };

    /// A pipeline for one image, whose size is that of the G-buffer. It refers to this scheduler.
    template <class In>
    Pipeline<In> open(const In& in, Image<Rgb>& image) const {
        static_assert(AccessibleFrom<decltype(in.visibility), Space::host>,
                      "mir: sched::CpuBlocks needs a Visibility that lives in host memory");
        static_assert(
            PacketVisibility<decltype(in.visibility)> || KnownVisibility<decltype(in.visibility)>,
            "mir: sched::CpuBlocks needs a Visibility with visible_packet(); use "
            "sched::Cpu for one that answers single segments only");
        static_assert(
            requires(TileIndex t) {
                in.gbuffer.view(t).hits.planes;
                in.gbuffer.view(t).surfaces.planes;
            },
            "mir: sched::CpuBlocks needs a G-buffer in planes, such as BlockedGBuffer; use "
            "sched::Cpu for others");
        return {in, image, *this};
    }
};
template <Executor E>
CpuBlocks(E&) -> CpuBlocks<E>;
template <Executor E>
CpuBlocks(E&, Monitor*) -> CpuBlocks<E>;
template <Executor E>
CpuBlocks(E&, Monitor*, InstructionSet) -> CpuBlocks<E>;

template <Executor E>
template <class In>
void CpuBlocks<E>::Pipeline<In>::run(blocks::Block b) const {
    run_with(scheduler_.instructions, [this, b](auto set) {
        const auto view = in_.gbuffer.view(b.tile);
        const LuxelBlock block(view.hits, view.surfaces, b, in_.shading);
        blocks::GroupRadiance sums[blocks::groups_per_block];
        if constexpr (KnownVisibility<V>) {
            // Masks first: they are at hand before the VPL is.
            add_vpls<set()>(block, sums, [&](VplIndex j, BlockMask& lit) {
                return blocks::find_known(block, j, in_.visibility, lit) &&
                       !is_out_of_reach(block, in_.vpls[j]);
            });
        } else {
            const blocks::BlockSight<V> sight(block, in_.visibility);
            add_vpls<set()>(block, sums, [&](VplIndex j, BlockMask& lit) {
                const Vpl vpl = in_.vpls[j];
                if (is_out_of_reach(block, vpl)) return false;
                lit = sight(vpl);
                return lit.any();
            });
        }
        store(b, sums);
    });
}

template <Executor E>
template <class In>
auto CpuBlocks<E>::Pipeline<In>::start(const blocks::PlacedPage& page) const -> std::vector<Work> {
    const auto view = in_.gbuffer.view(page.tile);
    std::vector<Work> works;
    works.reserve(page.page.blocks());
    for (std::uint32_t b = 0; b < page.page.blocks(); ++b) {
        const blocks::Block place{page.tile, page.page.block(b)};
        works.push_back({place, LuxelBlock(view.hits, view.surfaces, place, in_.shading)});
    }
    return works;
}

template <Executor E>
template <class In>
void CpuBlocks<E>::Pipeline<In>::run(const blocks::PlacedPage& page) const {
    run_with(scheduler_.instructions, [&](auto set) { run_page<set()>(page); });
}

/// Finds which luxels of the page see some VPLs, then shades block by block.
template <Executor E>
template <class In>
template <InstructionSet Set>
void CpuBlocks<E>::Pipeline<In>::run_page(const blocks::PlacedPage& page) const {
    std::vector<Work> works = start(page);
    blocks::PageSight<V> sight(
        in_.gbuffer.view(page.tile).hits, page.page, in_.visibility, Set, [&](std::uint32_t slot) {
            return works[slot / BlockedLayout::block_size].block.counts(slot %
                                                                        BlockedLayout::block_size);
        });
    constexpr std::uint32_t most = blocks::PageSight<V>::most_vpls;
    const auto matters = [&](const Vpl& vpl) {
        return std::any_of(works.begin(), works.end(),
                           [&](const Work& w) { return !is_out_of_reach(w.block, vpl); });
    };
    for (VplIndex first = 0; first < in_.vpls.size(); first += most) {
        const std::uint32_t count = std::min(most, in_.vpls.size() - first);
        const std::uint32_t seen = sight.look(in_.vpls, first, count, matters);
        for (std::uint32_t b = 0; b < works.size(); ++b)
            for (std::uint32_t rest = seen; rest != 0;) {
                const std::uint32_t k = mir::detail::pop_lowest(rest);
                const Vpl vpl = in_.vpls[first + k];
                if (is_out_of_reach(works[b].block, vpl)) continue;
                const BlockMask lit = sight.seen(b, k);
                if (lit.any()) works[b].batch.add(vpl, lit);
                if (works[b].batch.is_full()) shade<Set>(works[b]);
            }
    }
    for (Work& work : works) {
        shade<Set>(work);
        store(work.place, work.sums);
    }
}

/// Adds all VPLs. `find_lit(j, lit)` finds the luxels of the block that VPL j lights, false if
/// none.
template <Executor E>
template <class In>
template <InstructionSet Set, class FindLit>
void CpuBlocks<E>::Pipeline<In>::add_vpls(const LuxelBlock& block, blocks::GroupRadiance* sums,
                                          const FindLit& find_lit) const {
    if (block.none_counts) return;
    blocks::LitVpls batch;
    for (VplIndex j = 0; j < in_.vpls.size(); ++j) {
        BlockMask lit;
        if (!find_lit(j, lit)) continue;
        batch.add(in_.vpls[j], lit);
        if (batch.is_full()) batch.template shade<Set>(block, in_.shading, sums);
    }
    batch.template shade<Set>(block, in_.shading, sums);
}

template <Executor E>
template <class In>
void CpuBlocks<E>::Pipeline<In>::store(blocks::Block b, const blocks::GroupRadiance* sums) const {
    const Tile tile = in_.gbuffer.tiles()[b.tile];
    const Tile area = BlockedLayout::of(tile).block_area(tile, b.block);
    for (std::uint32_t y = 0; y < area.height; ++y)
        for (std::uint32_t x = 0; x < area.width; ++x) {
            const LuxelIndex i = BlockedLayout::inside(x, y);
            const blocks::GroupRadiance& sum = sums[i / blocks::group_size];
            const std::uint32_t k = i % blocks::group_size;
            image_(tile.x + area.x + x, tile.y + area.y + y) = {sum.r[k], sum.g[k], sum.b[k]};
        }
    if (scheduler_.monitor != nullptr)
        scheduler_.monitor->contributions +=
            std::uint64_t{area.width} * area.height * in_.vpls.size();
}

}  // namespace mir::sched
