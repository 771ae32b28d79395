// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/normalise/image_response.hpp"

namespace mir {

/// What VPLs of unit intensity do to one block of 16 x 16 luxels each: kernel over pairs of a block
/// of some rows of blocks of a tile and a VPL. Neighbouring indices are neighbouring VPLs of one
/// block, so that threads read neighbouring words and the same luxels. Sums lanes of sixteen luxels
/// in single and the lanes in double precision, exactly as ResponseSum does.
template <GBuffer G, VplSet P, Shading F>
struct BlockResponse {
    G luxels;                        ///< of the tile
    P vpls;                          ///< whose intensities are not read
    VisibilityWords<G::space> seen;  ///< of the tile: which luxels face and see which VPL
    F shade;  ///< luxels that it says to reflect nothing are not counted as lit
    std::uint32_t first_block = 0;  ///< of the tile
    std::uint32_t blocks_x = 0;     ///< of the tile
    VplIndex first_vpl = 0;         ///< that index 0 stands for
    std::uint32_t count = 0;        ///< VPLs
    ImageResponse* sums = nullptr;  ///< of the tile's first column of blocks
    std::uint32_t columns = 0;      ///< blocks side by side in the whole image

    /// Block first_block + i / count and VPL first_vpl + i % count. Writes their sum to element
    /// i % count of the `count` of that block; blocks lie in rows of `columns`.
    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t block = i / count;
        const std::uint32_t j = i % count;
        const std::size_t place = std::size_t{block / blocks_x} * columns + block % blocks_x;
        sums[place * count + j] = of(first_block + block, first_vpl + j);
    }

 private:
    static constexpr std::uint32_t lanes = 16;
    static constexpr std::uint32_t words =
        BlockedLayout::block_size / VisibilityWords<G::space>::width;

    /// The luxels of a block that see a VPL.
    struct Lit {
        std::uint32_t word[words];

        [[nodiscard]] MIR_HD bool any() const {
            std::uint32_t some = 0;
            for (std::uint32_t q = 0; q < words; ++q) some |= word[q];
            return some != 0;
        }
        /// Bit g: luxel 16 g + k.
        [[nodiscard]] MIR_HD std::uint32_t lane(std::uint32_t k) const {
            std::uint32_t groups = 0;
            for (std::uint32_t q = 0; q < words; ++q)
                groups |= (word[q] >> k & 1u) << 2 * q | (word[q] >> (lanes + k) & 1u)
                                                             << (2 * q + 1);
            return groups;
        }
    };

    [[nodiscard]] MIR_HD ImageResponse of(std::uint32_t block, VplIndex j) const {
        Lit lit;
        for (std::uint32_t q = 0; q < words; ++q)
            lit.word[q] = seen.words[(std::size_t{block} * words + q) * seen.vpls + j];
        ImageResponse sum;
        if (!lit.any()) return sum;
        Vpl unit = vpls[j];
        unit.intensity = {1.0f, 1.0f, 1.0f};
        for (std::uint32_t k = 0; k < lanes; ++k)
            add_lane(block * BlockedLayout::block_size + k, lit.lane(k), unit, sum);
        return sum;
    }

    /// Adds every sixteenth luxel from `first` on, where the bit is set.
    MIR_HD void add_lane(LuxelIndex first, std::uint32_t groups, const Vpl& unit,
                         ImageResponse& sum) const {
        Rgb lane;
        for (std::uint32_t g = 0; g < BlockedLayout::block_size / lanes; ++g) {
            if ((groups >> g & 1u) == 0) continue;
            const LuxelIndex i = first + lanes * g;
            const auto surface = luxels.surface(i);
            if constexpr (SurfaceSelectiveShading<F>)
                if (!shade.reflects(surface)) continue;
            lane += shade(luxels.hit(i), surface, unit);
            ++sum.lit_luxels;
        }
        sum.r += static_cast<double>(lane.r);
        sum.g += static_cast<double>(lane.g);
        sum.b += static_cast<double>(lane.b);
    }
};

template <class G, class P, class F>
BlockResponse(G, P, VisibilityWords<G::space>, F, std::uint32_t, std::uint32_t, VplIndex,
              std::uint32_t, ImageResponse*, std::uint32_t) -> BlockResponse<G, P, F>;

/// Adds up each row of blocks from left to right, in place: kernel over pairs of row and VPL.
struct SumBlockRow {
    ImageResponse* sums = nullptr;  ///< of blocks, as BlockResponse writes them
    std::uint32_t columns = 0;      ///< blocks of a row
    std::uint32_t count = 0;        ///< VPLs

    /// Row i / count and VPL i % count; the sum replaces that of the row's first block.
    MIR_HD void operator()(std::uint32_t i) const {
        ImageResponse* first = sums + std::size_t{i / count} * columns * count + i % count;
        ImageResponse sum = *first;
        for (std::uint32_t c = 1; c < columns; ++c) sum += first[std::size_t{c} * count];
        *first = sum;
    }
};

/// Adds rows of blocks to the totals from top to bottom: kernel over VPLs.
struct AddBlockRows {
    const ImageResponse* sums = nullptr;  ///< the sum of a row is its first element
    std::uint32_t rows = 0;               ///< of blocks
    std::size_t stride = 0;               ///< from row to row
    ImageResponse* totals = nullptr;      ///< by VPL; keep what was added before

    /// VPL `j`, counted from the first of `sums` and `totals`.
    MIR_HD void operator()(std::uint32_t j) const {
        ImageResponse total = totals[j];
        for (std::uint32_t row = 0; row < rows; ++row) total += sums[row * stride + j];
        totals[j] = total;
    }
};

}  // namespace mir
