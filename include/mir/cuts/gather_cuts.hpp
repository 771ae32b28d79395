// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/cuts/choose_cuts.hpp"
#include "mir/cuts/cut_place.hpp"
#include "mir/cuts/pick_numbers.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/contribution.hpp"

namespace mir {

/// Kernel for groups of lanes, two groups of 16 luxels each: gather_cut(), with its bits. Each lane
/// finds one of the picks of sixteen nodes; then luxels meet those of their group. Rays go before
/// what they found is shaded: neither then occupies the registers of the other (FusedKernel).
template <GBuffer G, Space S, Visibility V, Shading F>
struct GatherCuts {
    /// A picked VPL with the intensity of its node. Aligned so that the device fetches four words
    /// at a time.
    struct alignas(16) Pick {
        Vpl vpl;
    };
    /// What a group works in: picks, sixteen of each half of the lanes.
    struct Workspace {
        Pick picks[LaneGroup::width];
    };

    static constexpr std::uint32_t groups_of_block = 8;  ///< of lanes
    /// Of four groups of lanes each, that a GPU is to hold at least (FusedKernel).
    static constexpr std::uint32_t resident_blocks = 8;

    G luxels;                       ///< of the tile
    Tile tile;                      ///< where they lie
    VplTreeView<S> tree;            ///< that of the cuts
    V visibility;                   ///< asked VPL first, where both face each other
    F shade;                        ///< not asked for picks that are hidden
    CutPlace place;                 ///< of the G-buffer
    std::uint32_t first_block = 0;  ///< of the tile, the first of the table
    CutTable cuts;                  ///< read
    SoaView<Rgb> radiance;          ///< W m^-2 sr^-1 by blocked index

    /// Luxels of two groups of block first_block + i / groups_of_block.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const std::uint32_t at = i / groups_of_block;
        const LuxelIndex first = (first_block + at) * BlockedLayout::block_size;
        const std::uint32_t first_group = i % groups_of_block * 2;
        const LuxelPlace corner = BlockedLayout::of(tile).place(first);
        const Random numbers = place.numbers(tile.x + corner.x, tile.y + corner.y);
        LaneGroup::PerLane<LuxelIndex> own;
        LaneGroup::PerLane<Hit> hits;
        LaneGroup::PerLane<Rgb> sums;
        const std::uint32_t counting = group.ballot([&](std::uint32_t lane) {
            own[lane] = first + InterleavedOrder::place_of(first_group + lane / group_size,
                                                           lane % group_size);
            hits[lane] = luxels.hit(own[lane]);
            sums[lane] = {};
            return can_be_lit(shade, hits[lane], luxels.surface(own[lane]));
        });
        const std::uint32_t size = counting != 0 ? cuts.sizes[at] : 0;
        for (std::uint32_t n = 0; n < size; n += group_size) {
            const std::uint32_t count = size - n < group_size ? size - n : group_size;
            group.each([&](std::uint32_t lane) {
                const std::uint32_t k = lane % group_size;
                if (k < count)
                    space.picks[lane].vpl = picked(cuts.cut(at)[n + k], n + k,
                                                   first_group + lane / group_size, numbers);
            });
            group.each([&](std::uint32_t lane) {
                if ((counting >> lane & 1u) == 0) return;
                const Pick* const picks = space.picks + lane / group_size * group_size;
                const std::uint32_t seen = seen_from(hits[lane], picks, count);
                if (seen != 0) sums[lane] = shaded(own[lane], hits[lane], picks, seen, sums[lane]);
            });
        }
        group.each_apart([&](std::uint32_t lane) { radiance.store(own[lane], sums[lane]); });
    }

 private:
    static constexpr std::uint32_t group_size = InterleavedOrder::group_size;

    /// What node `i` of a cut picks for a group of luxels.
    [[nodiscard]] MIR_HD Vpl picked(const VplNode& node, std::uint32_t i, std::uint32_t luxels_of,
                                    const Random& numbers) const {
        const std::uint32_t leaf = tree.pick(node, PickNumbers::number(i, luxels_of, numbers));
        Vpl vpl = tree.leaves[leaf];
        vpl.intensity = vpl.intensity * tree.inverse_probability(node, leaf);
        return vpl;
    }

    /// Bit k is set where the luxel faces and sees pick k.
    [[nodiscard]] MIR_HD std::uint32_t seen_from(const Hit& hit, const Pick* picks,
                                                 std::uint32_t count) const {
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vpl& vpl = picks[k].vpl;
            if (faces(hit, vpl) && visibility.visible(vpl.position, hit.position)) seen |= 1u << k;
        }
        return seen;
    }

    [[nodiscard]] MIR_HD Rgb shaded(LuxelIndex i, const Hit& hit, const Pick* picks,
                                    std::uint32_t seen, Rgb sum) const {
        const auto luxel = PreparedLuxel<F>::of(shade, hit, luxels.surface(i));
        for (; seen != 0; seen &= seen - 1)
            sum += luxel.lit_by(picks[LaneGroup::lowest(seen)].vpl, shade);
        return sum;
    }
};
template <class G, Space S, class V, class F>
GatherCuts(G, Tile, VplTreeView<S>, V, F, CutPlace, std::uint32_t, CutTable, SoaView<Rgb>)
    -> GatherCuts<G, S, V, F>;

}  // namespace mir
