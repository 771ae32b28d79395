// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/data/blocked_layout.hpp"
#include "support/catch.hpp"

#include <cstdint>

// The axioms of GBuffer, on models that TiledGBuffer hands out. `fill(buffer, tile, index, hit)`
// writes a luxel; `without_surfaces(view)` gives the view whose surface planes are null.

namespace mirtest {

/// A hit that tells luxels apart.
inline mir::Hit numbered_hit(mir::TileIndex t, mir::LuxelIndex i) {
    return {{static_cast<float>(t), static_cast<float>(i), 0.5f}, {0, 0, 1}};
}

template <mir::TiledGBuffer T, class Fill>
void fill_all(T& buffer, const Fill& fill) {
    for (mir::TileIndex t = 0; t < buffer.tiles().size(); ++t) {
        const mir::Tile tile = buffer.tiles()[t];
        const auto layout = mir::BlockedLayout::of(tile);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x)
                fill(buffer, t, layout(x, y), numbered_hit(t, layout(x, y)));
    }
}

/// Axiom 1: hit() never touches surface memory. Reading a null plane would end the test program.
template <mir::TiledGBuffer T, class Fill, class WithoutSurfaces>
void hits_are_read_without_surfaces(T& buffer, const Fill& fill,
                                    const WithoutSurfaces& without_surfaces) {
    fill_all(buffer, fill);
    for (mir::TileIndex t = 0; t < buffer.tiles().size(); ++t) {
        const auto view = without_surfaces(buffer.view(t));
        for (mir::LuxelIndex i = 0; i < view.size(); ++i) {
            const mir::Hit hit = view.hit(i);
            if (mir::is_empty(hit)) continue;
            REQUIRE(hit.position == numbered_hit(t, i).position);
        }
    }
}

/// Axiom 2: luxels of the padding are empty, and all others are the ones that were stored.
template <mir::TiledGBuffer T, class Fill>
void padding_is_empty(T& buffer, const Fill& fill) {
    fill_all(buffer, fill);
    for (mir::TileIndex t = 0; t < buffer.tiles().size(); ++t) {
        const mir::Tile tile = buffer.tiles()[t];
        const auto view = buffer.view(t);
        const auto layout = mir::BlockedLayout::of(tile);
        REQUIRE(view.size() == layout.size());
        std::uint64_t stored = 0;
        for (mir::LuxelIndex i = 0; i < view.size(); ++i) {
            const mir::Hit hit = view.hit(i);
            if (mir::is_empty(hit)) continue;
            ++stored;
            REQUIRE(hit.position == numbered_hit(t, i).position);
        }
        REQUIRE(stored == std::uint64_t{tile.width} * tile.height);
    }
}

/// Every luxel starts empty, and the tiles cover the image.
template <mir::TiledGBuffer T>
void starts_empty(const T& buffer) {
    std::uint64_t area = 0;
    for (mir::TileIndex t = 0; t < buffer.tiles().size(); ++t) {
        area += std::uint64_t{buffer.tiles()[t].width} * buffer.tiles()[t].height;
        const auto view = buffer.view(t);
        for (mir::LuxelIndex i = 0; i < view.size(); ++i) REQUIRE(mir::is_empty(view.hit(i)));
    }
    CHECK(area == buffer.extent().area());
}

}  // namespace mirtest
