// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/luxel_block.hpp"
#include "mir/cuts/interleaved_order.hpp"
#include "mir/data/soa.hpp"

#include <array>
#include <cstdint>

namespace mir::blocks {

/// Copies a block of 256 luxels in InterleavedOrder.
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

 private:
    static constexpr std::uint32_t size = BlockedLayout::block_size;

    template <class T>
    using Planes = std::array<std::uint32_t, std::size_t{SoaView<T>::words} * size>;

    template <class T>
    static void copy(SoaView<T> from, std::uint32_t* to) {
        for (std::uint32_t word = 0; word < SoaView<T>::words; ++word)
            for (std::uint32_t i = 0; i < size; ++i)
                to[word * size + i] =
                    from.planes[word * from.stride +
                                InterleavedOrder::place_of(i / group_size, i % group_size)];
    }

    alignas(64) Planes<Hit> hits_;
    alignas(64) Planes<typename F::Surface> surfaces_;
};

}  // namespace mir::blocks
