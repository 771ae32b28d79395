// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/core/monitor.hpp"
#include "mir/cuts/cut_place.hpp"
#include "mir/cuts/gather_cut.hpp"
#include "mir/cuts/interleaved_block.hpp"
#include "mir/data/image.hpp"
#include "mir/shading/check_bound.hpp"

#include <vector>

namespace mir {

namespace detail {

/// One image by cuts; see reconstruct_cuts().
template <class G, class V, class F, class P>
class CutGather {
 public:
    CutGather(const G& gbuffer, const VplTree& tree, const V& visibility, const F& shading,
              const P& policy, const CutPlace& place, Image<Rgb>& image)
        : gbuffer_(gbuffer),
          tree_(tree),
          visibility_(visibility),
          shading_(shading),
          policy_(policy),
          place_(place),
          image_(image) {}

    /// Gathers the light of one block and returns how many picks it asked for.
    template <InstructionSet Set>
    [[nodiscard]] std::uint64_t run(blocks::Block b) const {
        const auto view = gbuffer_.view(b.tile);
        const blocks::InterleavedBlock<F> luxels(view.hits, view.surfaces, b);
        const CutBlock<F> block(luxels.hits(), luxels.surfaces(), {}, shading_);
        if (block.none_counts) return 0;
        const VplCut cut = policy_.template choose<Set>(block, tree_, shading_);
        const Tile tile = gbuffer_.tiles()[b.tile];
        const Tile area = BlockedLayout::of(tile).block_area(tile, b.block);
        CutPicks picks(place_.numbers(tile.x + area.x, tile.y + area.y), cut.size());
        blocks::GroupRadiance sums[blocks::groups_per_block];
        gather_cut<Set>(block, tree_, cut, picks, visibility_, shading_, sums);
        for (std::uint32_t y = 0; y < area.height; ++y)
            for (std::uint32_t x = 0; x < area.width; ++x)
                image_(tile.x + area.x + x, tile.y + area.y + y) =
                    light_of(sums, BlockedLayout::inside(x, y));
        return std::uint64_t{area.width} * area.height * cut.size();
    }

 private:
    static Rgb light_of(const blocks::GroupRadiance* sums, LuxelIndex luxel) {
        const std::uint32_t i = InterleavedOrder::place_here(luxel);
        const blocks::GroupRadiance& sum = sums[i / blocks::group_size];
        const std::uint32_t k = i % blocks::group_size;
        return {sum.r[k], sum.g[k], sum.b[k]};
    }

    const G& gbuffer_;
    const VplTree& tree_;
    const V& visibility_;
    const F& shading_;
    const P& policy_;
    CutPlace place_;
    Image<Rgb>& image_;
};

}  // namespace detail

/// Estimates the radiance of many VPLs through each luxel from a few of them. In W m^-2 sr^-1. For
/// each block of 256 luxels the policy cuts the tree, and each luxel gathers one VPL of each node,
/// picked by its weight. The mean over seeds is the image of reconstruct() with all VPLs of the
/// tree, for any policy; sixteen neighbours pick other VPLs, so that what is left is noise that
/// averages out. Emission is not included. `monitor` may be null; it counts pairs of luxel and
/// picked VPL. The same bytes for any number of threads, any tiles of whole blocks and any
/// `instructions`.
/// @throws Error(invalid_argument) when the shading has a bound that is none (check_bound()), or
///         bands begin within a block; Error(cancelled).
/// Source: Yuksel, "Stochastic Lightcuts", HPG 2019; docs/method.md, 14.
template <TiledGBuffer G, PacketVisibility V, Shading F, CutPolicy<F> P, Executor E>
Image<Rgb> reconstruct_cuts(const G& gbuffer, const VplTree& tree, const V& visibility,
                            const F& shading, const P& policy, const CutPlace& place, E& executor,
                            Monitor* monitor = nullptr,
                            InstructionSet instructions = best_instruction_set()) {
    check_shading(shading);
    expects(place.first_row % BlockedLayout::side == 0,
            "a band of luxels for cuts begins within a block (its picks would differ from those of "
            "the whole image); begin at a multiple of 16 rows");
    Image<Rgb> image(gbuffer.extent());
    if (tree.size() == 0) return image;
    std::vector<blocks::Block> all;
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t)
        blocks::append_blocks(all, t, gbuffer.tiles()[t]);
    const detail::CutGather<G, V, F, P> gather(gbuffer, tree, visibility, shading, policy, place,
                                               image);
    executor.for_each(all.size(), [&](std::size_t i) {
        if (monitor != nullptr) monitor->check();
        std::uint64_t picked = 0;
        run_with(instructions, [&](auto set) { picked = gather.template run<set()>(all[i]); });
        if (monitor != nullptr) monitor->contributions += picked;
    });
    return image;
}

}  // namespace mir
