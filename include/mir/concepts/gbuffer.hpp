// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/space.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/tile.hpp"

#include <concepts>
#include <span>
#include <vector>

namespace mir {

/// A view of the luxels of one tile, in blocked order.
///
/// Axioms (validation/gbuffer.hpp):
///  1. hit(i) never touches surface memory, so that visibility can run before surfaces arrive;
///  2. luxels of the padding are empty.
template <class G>
concept GBuffer = DeviceCopyable<G> && requires(const G g, LuxelIndex i) {
    { G::space } -> std::convertible_to<Space>;
    { g.size() } -> std::same_as<std::uint32_t>;
    { g.hit(i) } -> std::same_as<Hit>;
    { g.surface(i) } -> std::same_as<typename G::Surface>;
};

/// The luxels of an image, tile by tile, on the host: what reconstruct() is given.
template <class T>
concept TiledGBuffer = requires(const T t, TileIndex i) {
    { t.extent() } -> std::same_as<Extent>;
    { t.tiles() } -> std::same_as<const std::vector<Tile>&>;
    { t.view(i) } -> GBuffer;
};

/// A TiledGBuffer on the host whose tiles are runs of words. They can be copied to a device.
template <class T>
concept PackedGBuffer = TiledGBuffer<T> && requires(const T t, TileIndex i) {
    { t.hit_words_of(i) } -> std::same_as<std::span<const std::uint32_t>>;
    { t.surface_words_of(i) } -> std::same_as<std::span<const std::uint32_t>>;
};

}  // namespace mir
