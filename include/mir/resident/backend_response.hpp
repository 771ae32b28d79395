// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/response.hpp"
#include "mir/normalise/response_bands.hpp"
#include "mir/resident/backend_visibility.hpp"
#include "mir/resident/wait_at_end.hpp"

#include <algorithm>
#include <span>

namespace mir {

/// ResponseSum on a backend: what VPLs do to luxels of bands there. Their visibility lies there
/// too. The order of sums is that of the host: neither tiles nor memory change a bit, and bits are
/// those of the host where shading has the same. Totals alone come home, so that bands may be
/// summed on several backends. Memory: a sum for each VPL and row of blocks of a band, and
/// `partial_sums` more. Must not end before the work that it started, and what it reads must
/// outlive it: a queue of its own works on it too. Not thread-safe.
template <Backend B>
class BackendResponse {
 public:
    /// Of the backend.
    using Queue = typename B::Queue;

    /// For bands of up to `luxels` as wide as those, and a set of `vpls` VPLs. `partial_sums` of 32
    /// bytes may be kept of pairs of block and VPL; at least those of one row of blocks and 32 VPLs
    /// are.
    BackendResponse(const B& backend, Extent luxels, std::uint32_t vpls,
                    std::uint32_t partial_sums = 1u << 21)
        : most_(luxels),
          vpls_(vpls),
          chunk_(choose_chunk(luxels, vpls, partial_sums)),
          partial_(backend.template buffer<ImageResponse>(chunk_.sums())),
          rows_(backend.template buffer<ImageResponse>(
              std::size_t{detail::block_rows(luxels.height)} * vpls)),
          totals_(backend.template buffer<ImageResponse>(vpls)),
          beside_(backend.queue()) {}

    /// Starts to sum each row of blocks of a band, for all VPLs. `seen` holds the visibility of
    /// this band and these VPLs, whose intensities are not read.
    /// @throws Error(invalid_argument) when band, VPLs or visibility do not fit or tiles cut
    ///         blocks; what the backend throws.
    template <TiledGBuffer G, VplSet P, Shading F>
    void sum_rows(Queue& queue, const G& gbuffer, P vpls, const BackendVisibility<B>& seen,
                  const F& shading);

    /// Adds the rows of that band to totals of the bands above, by VPL. For ResponseSum::add_by().
    /// All work is done when it returns.
    /// @throws What the backend throws.
    void add_rows(Queue& queue, std::span<ImageResponse> totals);

 private:
    /// Pairs of block and VPL that are summed at a time.
    struct Chunk {
        std::uint32_t columns = 0;  ///< blocks side by side in the image
        std::uint32_t rows = 0;     ///< of blocks
        std::uint32_t vpls = 0;

        [[nodiscard]] std::size_t sums() const { return std::size_t{columns} * rows * vpls; }
    };

    static Chunk choose_chunk(Extent luxels, std::uint32_t vpls, std::uint32_t partial_sums) {
        const auto blocks = BlockedLayout::of({0, 0, luxels.width, luxels.height});
        const std::uint64_t columns = std::max(blocks.blocks_x, 1u);
        const std::uint64_t count =
            std::min<std::uint64_t>(std::max<std::uint64_t>(partial_sums / columns, 32), vpls);
        const std::uint64_t row = columns * std::max<std::uint64_t>(count, 1);
        const std::uint64_t rows =
            std::clamp<std::uint64_t>(partial_sums / row, 1, std::max(blocks.blocks_y, 1u));
        return {blocks.blocks_x, static_cast<std::uint32_t>(rows),
                static_cast<std::uint32_t>(count)};
    }

    /// What is added at a time. Some rows of blocks of a row of tiles, and some VPLs.
    struct Part {
        TileIndex first_tile = 0;
        std::uint32_t first_row = 0;  ///< of blocks, in the tiles
        std::uint32_t rows = 0;
        VplIndex first_vpl = 0;
        std::uint32_t vpls = 0;
    };

    /// Writes the sums of a part to `rows`, its first row and VPL.
    template <TiledGBuffer G, VplSet P, Shading F>
    void sum_part(Queue& queue, const G& gbuffer, P vpls, const BackendVisibility<B>& seen,
                  const F& shading, const Part& part, ImageResponse* rows);

    Extent most_;  ///< luxels of a band
    std::uint32_t vpls_;
    std::uint32_t block_rows_ = 0;  ///< of the band that was summed
    Chunk chunk_;
    typename B::template Buffer<ImageResponse> partial_;
    typename B::template Buffer<ImageResponse> rows_;
    typename B::template Buffer<ImageResponse> totals_;
    Queue beside_;  ///< every other tile; last, so that it ends before its memory goes
};

template <Backend B>
template <TiledGBuffer G, VplSet P, Shading F>
void BackendResponse<B>::sum_rows(Queue& queue, const G& gbuffer, P vpls,
                                  const BackendVisibility<B>& seen, const F& shading) {
    detail::check_whole_blocks(gbuffer.tiles());
    const auto grid = TileGrid::of(gbuffer.extent(), gbuffer.tiles());
    const std::uint32_t n = vpls.size();
    expects(seen.grid() == grid && seen.vpls() == n,
            "a response was given visibility of other luxels or VPLs (it would be of nothing); "
            "give that of this band");
    expects(n == vpls_ && grid.image.width == most_.width && grid.image.height <= most_.height,
            "a response was given luxels of another width, too many or other VPLs (it would be of "
            "nothing); give those it was made for");
    block_rows_ = detail::block_rows(grid.image.height);
    for (TileIndex first = 0; first < gbuffer.tiles().size(); first += grid.columns()) {
        const Tile tile = grid[first];
        const std::uint32_t rows = BlockedLayout::of(tile).blocks_y;
        for (std::uint32_t row = 0; row < rows; row += chunk_.rows)
            for (VplIndex j = 0; j < n; j += chunk_.vpls)
                sum_part(queue, gbuffer, vpls, seen, shading,
                         {first, row, std::min(chunk_.rows, rows - row), j,
                          std::min(chunk_.vpls, n - j)},
                         rows_.data() + (std::size_t{tile.y / BlockedLayout::side + row} * n + j));
    }
}

template <Backend B>
void BackendResponse<B>::add_rows(Queue& queue, std::span<ImageResponse> totals) {
    expects(totals.size() == vpls_,
            "a response was given totals of other VPLs (they would be of nothing); give one for "
            "each VPL that it was made for");
    const WaitAtEnd wait(queue);
    queue.upload(std::span<const ImageResponse>(totals), totals_);
    queue.for_each(vpls_, AddBlockRows{rows_.data(), block_rows_, vpls_, totals_.data()});
    queue.download(totals_, totals);
    queue.record().sync();
}

template <Backend B>
template <TiledGBuffer G, VplSet P, Shading F>
void BackendResponse<B>::sum_part(Queue& queue, const G& gbuffer, P vpls,
                                  const BackendVisibility<B>& seen, const F& shading,
                                  const Part& part, ImageResponse* rows) {
    const std::uint32_t n = part.vpls;
    const std::uint32_t tiles = seen.grid().columns();
    // Groups take unequally long: those of the next tile begin while the last of this one end.
    beside_.wait(queue.record());
    for (TileIndex t = part.first_tile; t < part.first_tile + tiles; ++t) {
        const Tile tile = gbuffer.tiles()[t];
        const std::uint32_t across = BlockedLayout::of(tile).blocks_x;
        ImageResponse* column = partial_.data() + std::size_t{tile.x / BlockedLayout::side} * n;
        const BlockResponse blocks{
            gbuffer.view(t), vpls, seen.tile(t), shading,       part.first_row * across, across,
            part.first_vpl,  n,    column,       chunk_.columns};
        Queue& of_tile = (t - part.first_tile) % 2 == 0 ? queue : beside_;
        of_tile.for_each_group(blocks.groups(part.rows * across), blocks);
    }
    queue.wait(beside_.record());
    queue.for_each(part.rows * n,
                   SumBlockRow{partial_.data(), chunk_.columns, n, rows, seen.vpls()});
}

}  // namespace mir
