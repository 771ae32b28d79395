// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/luxel_block.hpp"
#include "mir/data/soa.hpp"

#include <array>
#include <cstdint>

namespace mir::blocks {

/// Copies a block of 256 luxels in another order: each group has one luxel of each of the block's
/// sixteen squares of 4 x 4, and another place in each square. Groups pick other VPLs, so
/// neighbours do, and what a group has in common shows no lattice.
template <Shading F>
class InterleavedBlock {
 public:
    /// Of one of the blocks of a tile.
    InterleavedBlock(SoaView<const Hit> tile_hits, SoaView<const typename F::Surface> tile_surfaces,
                     Block b) {
        copy(starting_at(tile_hits, first_luxel(b)), hits_.data());
        copy(starting_at(tile_surfaces, first_luxel(b)), surfaces_.data());
    }

    /// Hits in the new order. Valid as long as this.
    [[nodiscard]] SoaView<const Hit> hits() const { return {hits_.data(), size}; }
    /// Surfaces in the new order. Valid as long as this.
    [[nodiscard]] SoaView<const typename F::Surface> surfaces() const {
        return {surfaces_.data(), size};
    }

    /// Place in the block of luxel `k` of group `s`, for k in square k.
    [[nodiscard]] static constexpr std::uint32_t place_of(std::uint32_t s, std::uint32_t k) {
        return k * group_size + (s ^ shift(k));
    }
    /// Place here of luxel `i` of the block.
    [[nodiscard]] static constexpr std::uint32_t place_here(std::uint32_t i) {
        const std::uint32_t square = i / group_size;
        return (i % group_size ^ shift(square)) * group_size + square;
    }

 private:
    static constexpr std::uint32_t size = BlockedLayout::block_size;
    /// Sixteen shifts, each once; those of neighbours differ in both directions. A shift keeps
    /// luxels of a square of 2 x 2 together.
    static constexpr std::uint32_t shift(std::uint32_t square) {
        constexpr std::array<std::uint8_t, 16> shifts{6, 11, 1, 12, 13, 0, 10, 7,
                                                      3, 14, 4, 9,  8,  5, 15, 2};
        return shifts[square];
    }

    template <class T>
    using Planes = std::array<std::uint32_t, std::size_t{SoaView<T>::words} * size>;

    template <class T>
    static void copy(SoaView<T> from, std::uint32_t* to) {
        for (std::uint32_t word = 0; word < SoaView<T>::words; ++word)
            for (std::uint32_t i = 0; i < size; ++i)
                to[word * size + i] =
                    from.planes[word * from.stride + place_of(i / group_size, i % group_size)];
    }

    alignas(64) Planes<Hit> hits_;
    alignas(64) Planes<typename F::Surface> surfaces_;
};

}  // namespace mir::blocks
