// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/response.hpp"
#include "mir/normalise/response_bands.hpp"
#include "mir/resident/backend_visibility.hpp"

#include <algorithm>

namespace mir {

/// ResponseSum on a backend. The response of VPLs over an image whose luxels and visibility lie in
/// the backend's memory, and come in bands of rows. The order of sums is that of ResponseSum, which
/// rows of blocks of the image define and neither tiles nor memory: the result has the same bits
/// for any bands and tiles that are whole blocks, and those of ResponseSum where shading has the
/// same bits. Memory: two sums per VPL and `partial_sums` more. Not thread-safe.
template <Backend B>
class BackendResponse {
 public:
    /// Of the backend.
    using Queue = typename B::Queue;

    /// For an image of `luxels` and a set of `vpls` VPLs. `partial_sums` of 32 bytes may be kept of
    /// pairs of block and VPL; at least those of one row of blocks and 32 VPLs are.
    BackendResponse(const B& backend, Extent luxels, std::uint32_t vpls,
                    std::uint32_t partial_sums = 1u << 21)
        : bands_(luxels, vpls),
          chunk_(choose_chunk(luxels, vpls, partial_sums)),
          partial_(backend.template buffer<ImageResponse>(chunk_.sums())),
          totals_(backend.template buffer<ImageResponse>(vpls)),
          at_home_(backend.template host_buffer<ImageResponse>(vpls)) {
        std::fill_n(at_home_.span().begin(), vpls, ImageResponse{});
    }

    /// Starts to add the rows below those added before. `seen` holds the visibility of this band
    /// and these VPLs, whose intensities are not read. All bands go to one queue.
    /// @throws Error(invalid_argument) when band, VPLs or visibility do not fit or tiles cut
    /// blocks.
    template <TiledGBuffer G, VplSet P, Shading F>
    void add_band(Queue& queue, const G& gbuffer, P vpls, const BackendVisibility<B>& seen,
                  const F& shading);

    /// Responses in the order of the VPLs, once all work on the queue is done.
    /// @throws Error(invalid_argument) before all rows were added.
    [[nodiscard]] std::vector<ImageResponse> mean(Queue& queue) {
        if (bands_.vpls() > 0) queue.download(totals_, at_home_.span());
        queue.record().sync();
        const std::span<const ImageResponse> sums = at_home_.span();
        return bands_.mean({sums.begin(), sums.end()});
    }

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

    template <TiledGBuffer G, VplSet P, Shading F>
    void add_part(Queue& queue, const G& gbuffer, P vpls, const BackendVisibility<B>& seen,
                  const F& shading, const Part& part);

    detail::ResponseBands bands_;
    Chunk chunk_;
    typename B::template Buffer<ImageResponse> partial_;
    typename B::template Buffer<ImageResponse> totals_;
    typename B::template HostBuffer<ImageResponse> at_home_;
};

template <Backend B>
template <TiledGBuffer G, VplSet P, Shading F>
void BackendResponse<B>::add_band(Queue& queue, const G& gbuffer, P vpls,
                                  const BackendVisibility<B>& seen, const F& shading) {
    bands_.check(gbuffer.extent(), gbuffer.tiles(), vpls.size());
    const auto grid = TileGrid::of(gbuffer.extent(), gbuffer.tiles());
    expects(seen.grid() == grid && seen.vpls() == vpls.size(),
            "a response was given visibility of other luxels or VPLs (it would be of nothing); "
            "give that of this band");
    const std::uint32_t n = vpls.size();
    if (n > 0 && bands_.none_yet())
        queue.upload(std::span<const ImageResponse>(at_home_.span()), totals_);
    for (TileIndex first = 0; first < gbuffer.tiles().size(); first += grid.columns()) {
        const std::uint32_t rows = BlockedLayout::of(grid[first]).blocks_y;
        for (std::uint32_t row = 0; row < rows; row += chunk_.rows)
            for (VplIndex j = 0; j < n; j += chunk_.vpls)
                add_part(queue, gbuffer, vpls, seen, shading,
                         {first, row, std::min(chunk_.rows, rows - row), j,
                          std::min(chunk_.vpls, n - j)});
    }
    bands_.count(gbuffer.extent());
}

template <Backend B>
template <TiledGBuffer G, VplSet P, Shading F>
void BackendResponse<B>::add_part(Queue& queue, const G& gbuffer, P vpls,
                                  const BackendVisibility<B>& seen, const F& shading,
                                  const Part& part) {
    const std::uint32_t n = part.vpls;
    const std::uint32_t tiles = seen.grid().columns();
    for (TileIndex t = part.first_tile; t < part.first_tile + tiles; ++t) {
        const Tile tile = gbuffer.tiles()[t];
        const std::uint32_t across = BlockedLayout::of(tile).blocks_x;
        ImageResponse* column = partial_.data() + std::size_t{tile.x / BlockedLayout::side} * n;
        const BlockResponse blocks{
            gbuffer.view(t), vpls, seen.tile(t), shading,       part.first_row * across, across,
            part.first_vpl,  n,    column,       chunk_.columns};
        queue.for_each_group(blocks.groups(part.rows * across), blocks);
    }
    queue.for_each(part.rows * n, SumBlockRow{partial_.data(), chunk_.columns, n});
    queue.for_each(n, AddBlockRows{partial_.data(), part.rows, std::size_t{chunk_.columns} * n,
                                   totals_.data() + part.first_vpl});
}

}  // namespace mir
