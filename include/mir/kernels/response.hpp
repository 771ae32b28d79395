// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/image_response.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/kernels/lane_sums.hpp"
#include "mir/kernels/vpl_rows.hpp"
#include "mir/shading/prepared_luxel.hpp"

namespace mir {

/// What VPLs of unit intensity do to one block of 16 x 16 luxels each. Kernel for groups, over
/// pairs of a block of some rows of blocks of a tile and 32 VPLs. Both halves of the group prepare
/// the same sixteen neighbouring luxels, then take one VPL each of those that any of them sees.
/// Sums lanes of sixteen luxels in single and the lanes in double precision, exactly as ResponseSum
/// does.
template <GBuffer G, VplSet P, Shading F>
struct BlockResponse {
    /// What a group works in.
    struct Workspace {
        VplRows vpls;   ///< those that some of sixteen luxels see come first
        LaneSums sums;  ///< of all
    };

    G luxels;                        ///< of the tile
    P vpls;                          ///< whose intensities are not read
    VisibilityWords<G::space> seen;  ///< of the tile: which luxels face and see which VPL
    /// A device asks for all lanes, black luxels too, and drops unlit ones. Luxels that it says to
    /// reflect nothing are not counted as lit.
    F shade;
    std::uint32_t first_block = 0;  ///< of the tile
    std::uint32_t blocks_x = 0;     ///< of the tile
    VplIndex first_vpl = 0;         ///< that is summed
    std::uint32_t count = 0;        ///< VPLs that are summed, not 0
    ImageResponse* sums = nullptr;  ///< of the tile's first column of blocks
    std::uint32_t columns = 0;      ///< blocks side by side in the whole image

    /// Groups that cover so many blocks and the VPLs that are summed.
    [[nodiscard]] std::uint32_t groups(std::uint32_t blocks) const { return blocks * runs(); }

    /// Group `i` < groups(). Block first_block + i / r and the VPLs from first_vpl + 32 (i % r) on;
    /// there are r runs of 32. Writes the sum of VPL first_vpl + j to element j of the `count` of
    /// that block; blocks lie in rows of `columns`.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const std::uint32_t block = i / runs();
        const std::uint32_t first = i % runs() * LaneGroup::width;
        LaneGroup::PerLane<Vpl> own_vpls;
        PerLaneBits lit_luxels;
        group.each([&](std::uint32_t lane) {
            const std::uint32_t own = first + lane;
            own_vpls[lane] = vpls[first_vpl + (own < count ? own : count - 1)];
            lit_luxels[lane] = 0;
            for (std::uint32_t k = 0; k < half; ++k)
                space.sums.put(LaneSums::column(LaneSums::row(lane), k), {});
        });
        add_block(group, first_block + block, first, own_vpls, lit_luxels, space);
        const std::size_t place = std::size_t{block / blocks_x} * columns + block % blocks_x;
        group.each([&](std::uint32_t lane) {
            if (first + lane < count)
                sums[place * count + first + lane] =
                    sum_of_lanes(lane, lit_luxels[lane], space.sums);
        });
    }

 private:
    using PerLaneBits = LaneGroup::PerLane<std::uint32_t>;
    using PerLaneVpls = LaneGroup::PerLane<Vpl>;
    using PerLaneLuxels = LaneGroup::PerLane<PreparedLuxel<F>>;
    static constexpr std::uint32_t half = LaneSums::columns;  ///< of a group: lanes of a sum
    static_assert(2 * half == LaneGroup::width);
    static constexpr std::uint32_t words =
        BlockedLayout::block_size / VisibilityWords<G::space>::width;

    [[nodiscard]] MIR_HD std::uint32_t runs() const {
        return (count + LaneGroup::width - 1) / LaneGroup::width;
    }

    /// Adds all luxels of a block, in their order. `first` counts from first_vpl.
    MIR_HD void add_block(const LaneGroup& group, std::uint32_t block, std::uint32_t first,
                          const PerLaneVpls& own_vpls, PerLaneBits& lit_luxels,
                          Workspace& space) const {
        const std::uint32_t* const of_block =
            seen.words + std::size_t{block} * words * seen.vpls + first_vpl + first;
        PerLaneBits own, next;
        const auto fetch = [&](std::uint32_t q, PerLaneBits& into) {
            group.each_apart([&](std::uint32_t lane) {
                const bool is_there = q < words && first + lane < count;
                into[lane] = is_there ? of_block[std::size_t{q} * seen.vpls + lane] : 0u;
            });
        };
        fetch(0, own);
        for (std::uint32_t q = 0; q < words; ++q) {
            fetch(q + 1, next);
            const LuxelIndex luxel = block * BlockedLayout::block_size + q * LaneGroup::width;
            PerLaneBits lit;
            group.each_apart([&](std::uint32_t lane) { lit[lane] = own[lane] & 0xFFFFu; });
            add_sixteen(group, luxel, own_vpls, lit, lit_luxels, space);
            group.each_apart([&](std::uint32_t lane) { lit[lane] = own[lane] >> half; });
            add_sixteen(group, luxel + half, own_vpls, lit, lit_luxels, space);
            group.each_apart([&](std::uint32_t lane) { own[lane] = next[lane]; });
        }
    }

    /// Adds luxels first_luxel to first_luxel + 15, each to its lane of the sums. `own_lit` has a
    /// bit for each that sees the VPL of a lane of the group.
    MIR_HD void add_sixteen(const LaneGroup& group, LuxelIndex first_luxel,
                            const PerLaneVpls& own_vpls, const PerLaneBits& own_lit,
                            PerLaneBits& lit_luxels, Workspace& space) const {
        const std::uint32_t seen_vpls =
            group.ballot([&](std::uint32_t lane) { return own_lit[lane] != 0; });
        if (seen_vpls == 0) return;
        PerLaneLuxels prepared;
        const std::uint32_t reflecting = prepare(group, first_luxel, prepared);
        const std::uint32_t n = LaneGroup::count(seen_vpls);
        group.each([&](std::uint32_t lane) {
            const std::uint32_t lit = own_lit[lane] & reflecting;
            lit_luxels[lane] += LaneGroup::count(lit);
            const std::uint32_t at = own_lit[lane] != 0
                                         ? LaneGroup::count_before(seen_vpls, lane)
                                         : n + LaneGroup::count_before(~seen_vpls, lane);
            space.vpls.keep(own_vpls[lane], lit, LaneSums::row(lane), at);
        });
        // Where n is odd, the second half gets one that no luxel sees, whose sums stay.
        for (std::uint32_t at = 0; at < n; at += 2) add_pair(group, prepared, at, space);
        // No half may go on to the next luxels while the other reads VPLs or adds to sums.
        group.each([](std::uint32_t) {});
    }

    /// Makes both halves of a group ready; returns which luxels reflect anything.
    [[nodiscard]] MIR_HD std::uint32_t prepare(const LaneGroup& group, LuxelIndex first_luxel,
                                               PerLaneLuxels& prepared) const {
        return group.ballot([&](std::uint32_t lane) {
            const LuxelIndex i = first_luxel + lane % half;
            const auto surface = luxels.surface(i);
            prepared[lane] = PreparedLuxel<F>::of(shade, luxels.hit(i), surface);
            if constexpr (SurfaceSelectiveShading<F>) return shade.reflects(surface);
            return true;
        });
    }

    /// Adds the VPLs in places `at` and `at` + 1 of the workspace. Each goes to one half of the
    /// group.
    MIR_HD void add_pair(const LaneGroup& group, const PerLaneLuxels& prepared, std::uint32_t at,
                         Workspace& space) const {
        group.each_apart([&](std::uint32_t lane) {
            const VplRows::Row row = space.vpls[at + lane / half];
            const std::uint32_t k = lane % half;
            const bool is_lit = (row.lit >> k & 1u) != 0;
            // As in WordShading, a lane of a warp would save nothing by leaving.
            if (!LaneGroup::is_warp && !is_lit) return;
            const Vpl unit{row.position, row.normal, {1.0f, 1.0f, 1.0f}};
            const Rgb c = prepared[lane].lit_by(unit, shade);
            const std::uint32_t place = LaneSums::column(row.number, k);
            space.sums.put(place, sum_if(is_lit, space.sums[place], c));
        });
    }

    [[nodiscard]] MIR_HD static ImageResponse sum_of_lanes(std::uint32_t vpl, std::uint32_t lit,
                                                           const LaneSums& sums) {
        ImageResponse sum;
        for (std::uint32_t k = 0; k < half; ++k) {
            const Rgb lane = sums[LaneSums::column(LaneSums::row(vpl), k)];
            sum.r += static_cast<double>(lane.r);
            sum.g += static_cast<double>(lane.g);
            sum.b += static_cast<double>(lane.b);
        }
        sum.lit_luxels = lit;
        return sum;
    }
};

template <class G, class P, class F>
BlockResponse(G, P, VisibilityWords<G::space>, F, std::uint32_t, std::uint32_t, VplIndex,
              std::uint32_t, ImageResponse*, std::uint32_t) -> BlockResponse<G, P, F>;

/// Adds up each row of blocks from left to right. Kernel over pairs of row and VPL.
struct SumBlockRow {
    const ImageResponse* blocks = nullptr;  ///< as BlockResponse writes them
    std::uint32_t columns = 0;              ///< blocks of a row
    std::uint32_t count = 0;                ///< VPLs
    ImageResponse* rows = nullptr;          ///< sums of VPLs, row after row
    std::size_t stride = 0;                 ///< from row to row of `rows`

    /// Row i / count and VPL i % count.
    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t row = i / count;
        const std::uint32_t vpl = i % count;
        const ImageResponse* const first = blocks + std::size_t{row} * columns * count + vpl;
        ImageResponse sum = *first;
        for (std::uint32_t c = 1; c < columns; ++c) sum += first[std::size_t{c} * count];
        rows[row * stride + vpl] = sum;
    }
};

/// Adds rows of blocks to totals, from top to bottom. Kernel over VPLs.
struct AddBlockRows {
    const ImageResponse* rows = nullptr;  ///< sums of VPLs, row after row
    std::uint32_t count = 0;              ///< rows
    std::uint32_t vpls = 0;
    ImageResponse* totals = nullptr;  ///< by VPL; keep what was added before

    /// VPL `j`.
    MIR_HD void operator()(std::uint32_t j) const {
        ImageResponse total = totals[j];
        for (std::uint32_t row = 0; row < count; ++row) total += rows[std::size_t{row} * vpls + j];
        totals[j] = total;
    }
};

}  // namespace mir
