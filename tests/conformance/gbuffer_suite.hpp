// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/passes.hpp"
#include "mir/validation/gbuffer.hpp"

#include <cstdint>

// The axioms of GBuffer, on models that TiledGBuffer hands out. `fill(buffer, tile, index, hit)`
// writes a luxel; `without_surfaces(view)` gives the view whose surface planes are null.

namespace mirtest {

/// A hit that tells the luxels of an image apart.
inline mir::Hit numbered_hit(std::uint32_t x, std::uint32_t y) {
    return {{static_cast<float>(x), static_cast<float>(y), 0.5f}, {0, 0, 1}};
}

template <mir::TiledGBuffer T, class Fill>
void fill_all(T& buffer, const Fill& fill) {
    for (mir::TileIndex t = 0; t < buffer.tiles().size(); ++t) {
        const mir::Tile tile = buffer.tiles()[t];
        const auto layout = mir::BlockedLayout::of(tile);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x)
                fill(buffer, t, layout(x, y), numbered_hit(tile.x + x, tile.y + y));
    }
}

/// A buffer whose surfaces are not there: reading one would end the test program.
template <mir::TiledGBuffer T, class WithoutSurfaces>
struct HitsAlone {
    const T& buffer;
    const WithoutSurfaces& without_surfaces;

    [[nodiscard]] mir::Extent extent() const { return buffer.extent(); }
    [[nodiscard]] const std::vector<mir::Tile>& tiles() const { return buffer.tiles(); }
    [[nodiscard]] auto view(mir::TileIndex t) const { return without_surfaces(buffer.view(t)); }
};

/// Axiom 1: hit() never touches surface memory.
template <mir::TiledGBuffer T, class Fill, class WithoutSurfaces>
void hits_are_read_without_surfaces(T& buffer, const Fill& fill,
                                    const WithoutSurfaces& without_surfaces) {
    fill_all(buffer, fill);
    const HitsAlone<T, WithoutSurfaces> hits{buffer, without_surfaces};
    passes(mir::validation::check_gbuffer(hits, numbered_hit));
}

/// Axiom 2: luxels of the padding are empty, and all others are the ones that were stored.
template <mir::TiledGBuffer T, class Fill>
void padding_is_empty(T& buffer, const Fill& fill) {
    fill_all(buffer, fill);
    passes(mir::validation::check_gbuffer(buffer, numbered_hit));
}

/// Every luxel starts empty, and the tiles cover the image.
template <mir::TiledGBuffer T>
void starts_empty(const T& buffer) {
    const auto nothing = [](std::uint32_t, std::uint32_t) { return mir::Hit{}; };
    passes(mir::validation::check_gbuffer(buffer, nothing));
}

}  // namespace mirtest
