// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/data/tile.hpp"

namespace mir {

/// Visibility found before: which luxels of a tile face and see which VPL. It belongs to one
/// G-buffer and one list of VPLs, whose intensities and surfaces may change.
///
/// Axioms (tests/data/visibility_matrix_test.cpp):
///  1. sees(t, i, j) is faces() and visible() of luxel i of tile t and VPL j;
///  2. block_masks(t, b, j) are 16 masks, and bit k of mask g is sees(t, 256 b + 16 g + k, j).
template <class V>
concept KnownVisibility = DeviceCopyable<V> &&
    requires(const V v, TileIndex t, LuxelIndex i, std::uint32_t block, VplIndex j) {
    { V::space } -> std::convertible_to<Space>;
    { v.sees(t, i, j) } -> std::same_as<bool>;
    { v.block_masks(t, block, j) } -> std::same_as<const std::uint16_t*>;
};

/// What a scheduler gets as visibility: rays to trace, or bits already traced.
template <class V>
concept VisibilitySource = Visibility<V> || KnownVisibility<V>;

}  // namespace mir
