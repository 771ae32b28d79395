// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/lit_vpls.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "mir/normalise/response_bands.hpp"
#include "mir/shading/check_bound.hpp"

#include <bit>
#include <span>

namespace mir {

/// Sums responses over an image that comes in bands of rows. t_v = 1/M sum_l V f min(G, b) over all
/// M luxels, empty ones included (docs/method.md, 10.2). Luxels are summed in the fixed order of
/// blocks of 16 x 16, left to right and top to bottom, in double, so that the result has the same
/// bits for any bands and tiles that are whole blocks, and for any executor.
class ResponseSum {
 public:
    /// For an image of `luxels` and a set of `vpls` VPLs.
    ResponseSum(Extent luxels, std::uint32_t vpls) : bands_(luxels, vpls), sums_(vpls) {}

    /// Adds the rows below those added before. `bits` are those of this band and these VPLs, whose
    /// intensities are not read.
    /// @throws Error(invalid_argument) when band, VPLs or bits do not fit or tiles cut blocks.
    template <TiledGBuffer G, VplSet P, KnownVisibility V, Shading F, Executor E>
    void add_band(const G& gbuffer, P vpls, V bits, const F& shading, E& executor,
                  InstructionSet instructions = best_instruction_set());

    /// The same of a band whose sums (block_row_responses()) were found before, wherever that was.
    /// @throws Error(invalid_argument) when band or sums do not fit.
    void add_rows(Extent band, std::span<const ImageResponse> rows) {
        expects(rows.size() == std::size_t{detail::block_rows(band.height)} * bands_.vpls(),
                "a response was given sums of other rows or VPLs (they would be of nothing); give "
                "one for each VPL and row of blocks of the band");
        add_by(band, [rows](std::span<ImageResponse> totals) {
            for (auto row = rows; !row.empty(); row = row.subspan(totals.size()))
                for (std::size_t j = 0; j < totals.size(); ++j) totals[j] += row[j];
        });
    }

    /// The same where another knows those sums. add(totals) adds each VPL's to its total, row by
    /// row from top to bottom. An exception of it ends the sum, which then is of no use.
    /// @throws Error(invalid_argument) when the band does not fit; what `add` throws.
    template <class Add>
    void add_by(Extent band, const Add& add) {
        bands_.check(band, bands_.vpls());
        add(std::span(sums_));
        bands_.count(band);
    }

    /// Goes on below rows that another sum of this image and these VPLs has added.
    /// @throws Error(invalid_argument) when the sums are of other VPLs, or the rows of another
    /// image.
    void go_on(std::uint32_t rows, std::span<const ImageResponse> sums) {
        bands_.go_on(rows, sums.size());
        sums_.assign(sums.begin(), sums.end());
    }
    /// Rows of luxels added so far.
    [[nodiscard]] std::uint32_t rows() const { return bands_.rows(); }
    /// Sums over those rows, for another to go on.
    [[nodiscard]] std::span<const ImageResponse> sums() const { return sums_; }

    /// Responses in the order of the VPLs.
    /// @throws Error(invalid_argument) before all rows were added.
    [[nodiscard]] std::vector<ImageResponse> mean() const { return bands_.mean(sums_); }

 private:
    detail::ResponseBands bands_;
    std::vector<ImageResponse> sums_;
};

namespace detail {

/// VPLs that one task sums. Enough to pay for reading a block, few enough to share out.
inline constexpr std::uint32_t vpls_per_task = 32;
static_assert(vpls_per_task <= blocks::LitVpls::capacity);

/// Adds what VPLs first .. last - 1, those of a task, do to the luxels of one block to their sums.
template <InstructionSet Set, VplSet P, KnownVisibility V, Shading F>
void add_block(const blocks::LuxelBlock<F>& block, const P& vpls, const V& bits, const F& shading,
               VplIndex first, VplIndex last, ImageResponse* sums) {
    using namespace blocks;
    GroupRadiance lanes[vpls_per_task];
    LitVpls lit_vpls;
    for (VplIndex j = first; j < last; ++j) {
        BlockMask lit;
        find_known(block, j, bits, lit);
        Vpl unit = vpls[j];
        unit.intensity = {1.0f, 1.0f, 1.0f};
        lit_vpls.add(unit, lit);
        for (const std::uint32_t mask : lit.packet)
            sums[j].lit_luxels += static_cast<std::uint64_t>(std::popcount(mask));
    }
    lit_vpls.template shade_each<Set>(block, shading, lanes);
    for (VplIndex j = first; j < last; ++j) {
        const GroupRadiance& of_vpl = lanes[j - first];
        ImageResponse sum;
        for (std::uint32_t k = 0; k < group_size; ++k) {
            sum.r += static_cast<double>(of_vpl.r[k]);
            sum.g += static_cast<double>(of_vpl.g[k]);
            sum.b += static_cast<double>(of_vpl.b[k]);
        }
        sums[j] += sum;
    }
}

/// Adds one row of blocks of a band, left to right, for VPLs first .. last - 1. last - 1.
template <InstructionSet Set, TiledGBuffer G, VplSet P, KnownVisibility V, Shading F>
void add_block_row(const G& gbuffer, const P& vpls, const V& bits, const F& shading,
                   std::uint32_t row, VplIndex first, VplIndex last, ImageResponse* sums) {
    constexpr std::uint32_t side = BlockedLayout::side;
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
        const Tile tile = gbuffer.tiles()[t];
        const auto layout = BlockedLayout::of(tile);
        const std::uint32_t row_of_tile = row - tile.y / side;
        if (row < tile.y / side || row_of_tile >= layout.blocks_y) continue;
        const auto view = gbuffer.view(t);
        for (std::uint32_t x = 0; x < layout.blocks_x; ++x) {
            const blocks::Block place{t, row_of_tile * layout.blocks_x + x};
            const blocks::LuxelBlock<F> block(view.hits, view.surfaces, place, shading);
            if (block.none_counts) continue;
            add_block<Set>(block, vpls, bits, shading, first, last, sums);
        }
    }
}

}  // namespace detail

/// Sums over the luxels of each row of blocks of a band. In the order of ResponseSum: those of all
/// VPLs, row after row from top to bottom. Otherwise as ResponseSum::add_band().
/// @throws Error(invalid_argument) when VPLs or bits do not fit or tiles cut blocks.
template <TiledGBuffer G, VplSet P, KnownVisibility V, Shading F, Executor E>
[[nodiscard]] std::vector<ImageResponse> block_row_responses(
    const G& gbuffer, P vpls, V bits, const F& shading, E& executor,
    InstructionSet instructions = best_instruction_set()) {
    detail::check_whole_blocks(gbuffer.tiles());
    check_shading(shading);
    const std::uint32_t count = vpls.size();
    const std::uint32_t rows = detail::block_rows(gbuffer.extent().height);
    const std::uint32_t tasks = (count + detail::vpls_per_task - 1) / detail::vpls_per_task;
    std::vector<ImageResponse> row_sums(std::size_t{rows} * count);
    executor.for_each(std::size_t{rows} * tasks, [&](std::size_t i) {
        const auto row = static_cast<std::uint32_t>(i / tasks);
        const VplIndex first = static_cast<std::uint32_t>(i % tasks) * detail::vpls_per_task;
        const VplIndex last = std::min(first + detail::vpls_per_task, count);
        ImageResponse* sums = row_sums.data() + std::size_t{row} * count;
        run_with(instructions, [&](auto set) {
            detail::add_block_row<set()>(gbuffer, vpls, bits, shading, row, first, last, sums);
        });
    });
    return row_sums;
}

template <TiledGBuffer G, VplSet P, KnownVisibility V, Shading F, Executor E>
void ResponseSum::add_band(const G& gbuffer, P vpls, V bits, const F& shading, E& executor,
                           InstructionSet instructions) {
    bands_.check(gbuffer.extent(), vpls.size());
    add_rows(gbuffer.extent(),
             block_row_responses(gbuffer, vpls, bits, shading, executor, instructions));
}

/// Responses of VPLs over an image that one G-buffer holds; see ResponseSum.
/// @throws Error(invalid_argument) when the matrix belongs to other VPLs or tiles cut blocks.
template <TiledGBuffer G, VplSet P, Shading F, Executor E>
std::vector<ImageResponse> response(const G& gbuffer, P vpls, const VisibilityMatrix& matrix,
                                    const F& shading, E& executor) {
    ResponseSum sum(gbuffer.extent(), matrix.vpls());
    sum.add_band(gbuffer, vpls, matrix.view(), shading, executor);
    return sum.mean();
}

}  // namespace mir
