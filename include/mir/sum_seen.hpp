// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/data/image.hpp"
#include "mir/data/visibility_matrix.hpp"

#include <utility>
#include <vector>

namespace mir {

/// Sum of `contribution(hit, surface, j)` over the VPLs that a luxel sees, W m^-2 sr^-1. It is
/// made for every luxel with `reflects(surface)`; `matrix` says which luxel sees which VPL. For
/// shadings that need more of a VPL than a Vpl; others go through a Scheduler. VPLs are summed in
/// their order, so that tiles and threads change no bit.
/// @throws Error(invalid_argument) when the matrix belongs to other tiles or another number of
/// VPLs.
template <TiledGBuffer G, class Reflects, class Contribution, Executor E>
Image<Rgb> sum_seen(const G& gbuffer, const VisibilityMatrix& matrix, std::uint32_t vpls,
                    const Reflects& reflects, const Contribution& contribution, E& executor) {
    expects(matrix.tiles() == gbuffer.tiles().size() && matrix.vpls() == vpls,
            "visibility was used for luxels or VPLs that it was not made for (they do not fit); "
            "make it for these");
    std::vector<std::pair<TileIndex, std::uint32_t>> rows;
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t)
        for (std::uint32_t y = 0; y < gbuffer.tiles()[t].height; ++y) rows.emplace_back(t, y);

    Image<Rgb> image(gbuffer.extent());
    executor.for_each(rows.size(), [&](std::size_t r) {
        const auto [t, y] = rows[r];
        const Tile tile = gbuffer.tiles()[t];
        const auto luxels = gbuffer.view(t);
        const auto layout = BlockedLayout::of(tile);
        const VisibilityMatrix::View bits = matrix.view();
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            const LuxelIndex i = layout(x, y);
            const Hit hit = luxels.hit(i);
            const auto surface = luxels.surface(i);
            if (is_empty(hit) || !reflects(surface)) continue;
            Rgb sum;
            for (VplIndex j = 0; j < vpls; ++j)
                if (bits.sees(t, i, j)) sum += contribution(hit, surface, j);
            image(tile.x + x, tile.y + y) = sum;
        }
    });
    return image;
}

}  // namespace mir
