// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/sky_passes.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace mir {

/// Where luxels see the environment, found on a backend. One tile at a time and one queue.
template <class B>
class BackendSkies {
 public:
    /// Room for the largest of the tiles.
    /// @throws What the backend throws.
    BackendSkies(const B& backend, std::span<const Tile> tiles)
        : tried_(backend.template buffer<SkyTried>(most_blocks(tiles) * sky_sets)),
          guides_(backend.template buffer<SkyGuide>(most_blocks(tiles))) {}

    /// Finds the guides of a tile's blocks, on the queue. They are good until the next call.
    template <class G, Visibility V>
    [[nodiscard]] const SkyGuide* find(typename B::Queue& queue, const G& luxels, Tile tile,
                                       const LuxelBand& band, const SkyTries<V>& tries) {
        const std::uint32_t blocks = BlockedLayout::of(tile).blocks();
        for (std::uint32_t set = 0; set < sky_sets; ++set)
            queue.for_each(blocks * SkyTried::side,
                           SkyTryPass{luxels, tile, band, tries, set, tried_.data()});
        queue.for_each(blocks, SkyGuidePass{tried_.data(), blocks, guides_.data()});
        return guides_.data();
    }

 private:
    static std::size_t most_blocks(std::span<const Tile> tiles) {
        std::size_t most = 0;
        for (const Tile& tile : tiles)
            most = std::max(most, std::size_t{BlockedLayout::of(tile).blocks()});
        return most;
    }

    typename B::template Buffer<SkyTried> tried_;
    typename B::template Buffer<SkyGuide> guides_;
};

}  // namespace mir
