// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "mir/sched/detail/luxel_block.hpp"

#include <bit>

namespace mir {

/// What a VPL of intensity 1 W sr^-1 in each channel does to an image.
struct ImageResponse {
    double r = 0.0;  ///< t_v: mean radiance over all luxels, W m^-2 sr^-1 per W sr^-1
    double g = 0.0;
    double b = 0.0;
    std::uint64_t lit_luxels = 0;  ///< luxels that see the VPL and reflect something

    ImageResponse& operator+=(const ImageResponse& o) {
        r += o.r;
        g += o.g;
        b += o.b;
        lit_luxels += o.lit_luxels;
        return *this;
    }
};

/// Sums responses over an image that comes in bands of rows: t_v = 1/M sum_l V f min(G, b) over all
/// M luxels, empty ones included (docs/method.md, 10.2). Luxels are summed in the fixed order of
/// blocks of 16 x 16, left to right and top to bottom, in double, so that the result has the same
/// bits for any bands and tiles that are whole blocks, and for any executor.
class ResponseSum {
 public:
    /// For an image of `luxels` and a set of `vpls` VPLs.
    ResponseSum(Extent luxels, std::uint32_t vpls) : luxels_(luxels), sums_(vpls) {}

    /// Adds the rows below those added before. `bits` are those of this band and these VPLs, whose
    /// intensities are not read.
    /// @throws Error(invalid_argument) when band, VPLs or bits do not fit or tiles cut blocks.
    template <TiledGBuffer G, VplSet P, KnownVisibility V, Shading F, Executor E>
    void add_band(const G& gbuffer, P vpls, V bits, const F& shading, E& executor,
                  InstructionSet instructions = best_instruction_set());

    /// Responses in the order of the VPLs.
    /// @throws Error(invalid_argument) before all rows were added.
    [[nodiscard]] std::vector<ImageResponse> mean() const;

 private:
    /// VPLs that one task sums: enough to pay for reading a block, few enough to share out.
    static constexpr std::uint32_t vpls_per_task = 32;

    void check(Extent band, const std::vector<Tile>& tiles, std::uint32_t vpls) const;

    Extent luxels_;
    std::uint32_t rows_ = 0;
    std::vector<ImageResponse> sums_;
};

namespace detail {

/// Sum over one block of what a VPL does to its luxels.
template <VplSet P, KnownVisibility V, Shading F>
ImageResponse block_response(const sched::detail::LuxelBlock<F>& block, const P& vpls, VplIndex j,
                             const V& bits, const F& shading) {
    using namespace sched::detail;
    Vpl unit = vpls[j];
    unit.intensity = {1.0f, 1.0f, 1.0f};
    BlockRadiance lanes;
    ImageResponse sum;
    for (std::uint32_t group = 0; group < groups_per_block; ++group) {
        const std::uint32_t lit = known_mask(block, group, j, bits);
        if (lit == 0) continue;
        const std::uint32_t first = group * group_size;
        add_shaded(starting_at(block.hits, first), starting_at(block.surfaces, first), unit,
                   shading, lit, lanes.r, lanes.g, lanes.b);
        sum.lit_luxels += static_cast<std::uint64_t>(std::popcount(lit));
    }
    for (std::uint32_t k = 0; k < group_size; ++k) {
        sum.r += static_cast<double>(lanes.r[k]);
        sum.g += static_cast<double>(lanes.g[k]);
        sum.b += static_cast<double>(lanes.b[k]);
    }
    return sum;
}

/// Adds the blocks of one row of blocks of a band, left to right, for VPLs first .. last - 1.
template <TiledGBuffer G, VplSet P, KnownVisibility V, Shading F>
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
            const sched::detail::Block place{t, row_of_tile * layout.blocks_x + x};
            const sched::detail::LuxelBlock<F> block(view.hits, view.surfaces, place, shading);
            if (block.bounds.empty) continue;
            for (VplIndex j = first; j < last; ++j)
                sums[j] += block_response(block, vpls, j, bits, shading);
        }
    }
}

}  // namespace detail

inline void ResponseSum::check(Extent band, const std::vector<Tile>& tiles,
                               std::uint32_t vpls) const {
    expects(vpls == sums_.size() && band.width == luxels_.width &&
                band.height <= luxels_.height - rows_,
            "a response was given luxels or VPLs of another image (it would be the mean of "
            "nothing); give the bands of one image from top to bottom");
    bool whole = rows_ % BlockedLayout::side == 0;
    for (const Tile& t : tiles)
        whole = whole && t.x % BlockedLayout::side == 0 && t.y % BlockedLayout::side == 0;
    expects(whole,
            "tiles or bands cut blocks of 16x16 luxels (the order of sums would depend on "
            "them); round sizes up with whole_blocks()");
}

template <TiledGBuffer G, VplSet P, KnownVisibility V, Shading F, Executor E>
void ResponseSum::add_band(const G& gbuffer, P vpls, V bits, const F& shading, E& executor,
                           InstructionSet instructions) {
    check(gbuffer.extent(), gbuffer.tiles(), vpls.size());
    const std::uint32_t count = vpls.size();
    const std::uint32_t rows =
        (gbuffer.extent().height + BlockedLayout::side - 1) / BlockedLayout::side;
    const std::uint32_t tasks = (count + vpls_per_task - 1) / vpls_per_task;
    std::vector<ImageResponse> row_sums(std::size_t{rows} * count);
    executor.for_each(std::size_t{rows} * tasks, [&](std::size_t i) {
        const auto row = static_cast<std::uint32_t>(i / tasks);
        const VplIndex first = static_cast<std::uint32_t>(i % tasks) * vpls_per_task;
        const VplIndex last = std::min(first + vpls_per_task, count);
        ImageResponse* sums = row_sums.data() + std::size_t{row} * count;
        run_with(instructions, [&] {
            detail::add_block_row(gbuffer, vpls, bits, shading, row, first, last, sums);
        });
    });
    for (std::size_t i = 0; i < row_sums.size(); ++i) sums_[i % count] += row_sums[i];
    rows_ += gbuffer.extent().height;
}

inline std::vector<ImageResponse> ResponseSum::mean() const {
    expects(rows_ == luxels_.height,
            "a response was asked for before every row of the image was added (the mean is over "
            "all luxels); add the bands that are missing");
    const double share = 1.0 / static_cast<double>(luxels_.area());
    std::vector<ImageResponse> means = sums_;
    for (ImageResponse& m : means) m = {m.r * share, m.g * share, m.b * share, m.lit_luxels};
    return means;
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
