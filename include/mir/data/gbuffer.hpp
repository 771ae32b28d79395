// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"

#include <memory>
#include <span>
#include <vector>

namespace mir {

/// The luxels of one tile: hits and surfaces in separate planes. Model of GBuffer.
template <Space S, class Params>
struct GBufferView {
    static constexpr Space space = S;      ///< of the memory of both planes
    using Surface = mir::Surface<Params>;  ///< what a luxel tells shading
    template <Space Other>
    using In = GBufferView<Other, Params>;  ///< the same luxels in other memory

    SoaView<const Hit> hits;          ///< by blocked index, of the luxels and the padding
    SoaView<const Surface> surfaces;  ///< the same of surfaces

    /// Luxels, padding included.
    [[nodiscard]] MIR_HD std::uint32_t size() const { return hits.stride; }
    /// Of blocked index `i` < size(); reads no surface.
    [[nodiscard]] MIR_HD Hit hit(LuxelIndex i) const { return hits.load(i); }
    /// Of blocked index `i` < size(); that of an empty luxel means nothing.
    [[nodiscard]] MIR_HD Surface surface(LuxelIndex i) const { return surfaces.load(i); }
};

/// Owner of the luxels of an image, or of a band, on the host. A blocked structure of arrays: each
/// tile has a contiguous run of hit words and one of surface words, so a tile is two copies.
/// `Alloc` may hand out pinned memory. Filling different luxels from different threads is safe.
template <class Params, class Alloc = std::allocator<std::uint32_t>>
class BlockedGBuffer {
 public:
    using Surface = mir::Surface<Params>;           ///< what a luxel tells shading
    using View = GBufferView<Space::host, Params>;  ///< of a tile, for the host

    /// All luxels start empty.
    /// @throws Error(invalid_argument) when an extent is zero.
    BlockedGBuffer(Extent extent, Extent tile_size, const Alloc& alloc = {})
        : extent_(extent), tiles_(cut_into_tiles(extent, tile_size)), words_(alloc) {
        first_luxel_.push_back(0);
        for (const Tile& t : tiles_)
            first_luxel_.push_back(first_luxel_.back() + BlockedLayout::of(t).size());
        words_.resize(first_luxel_.back() * (hit_words + surface_words));
    }

    /// Luxels of the image or band, without padding.
    [[nodiscard]] Extent extent() const { return extent_; }
    /// As cut_into_tiles() returns them; all other members count tiles by their place here.
    [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }

    /// The luxels of a tile. Valid until the buffer is assigned to, moved or ends.
    [[nodiscard]] View view(TileIndex t) const {
        return {{hit_plane(t), luxels(t)}, {surface_plane(t), luxels(t)}};
    }

    /// Words of a tile's hits and of its surfaces, as copied to a device.
    [[nodiscard]] std::span<const std::uint32_t> hit_words_of(TileIndex t) const {
        return {hit_plane(t), std::size_t{luxels(t)} * hit_words};
    }
    /// The same of surfaces, which follow the tile's hits in memory.
    [[nodiscard]] std::span<const std::uint32_t> surface_words_of(TileIndex t) const {
        return {surface_plane(t), std::size_t{luxels(t)} * surface_words};
    }

    /// All words, tile after tile, for copies of a whole image.
    [[nodiscard]] std::span<std::uint32_t> words() { return words_; }
    /// The same, to be read.
    [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }

    /// Writes luxel `i` (blocked index) of tile `t`.
    void store(TileIndex t, LuxelIndex i, const Hit& hit, const Surface& surface) {
        SoaView<Hit>{words_.data() + hit_offset(t), luxels(t)}.store(i, hit);
        SoaView<Surface>{words_.data() + surface_offset(t), luxels(t)}.store(i, surface);
    }

    /// Bytes held, for reports.
    [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint32_t); }

 private:
    static constexpr std::size_t hit_words = SoaView<Hit>::words;
    static constexpr std::size_t surface_words = SoaView<Surface>::words;

    [[nodiscard]] std::uint32_t luxels(TileIndex t) const {
        return static_cast<std::uint32_t>(first_luxel_[t + 1] - first_luxel_[t]);
    }
    [[nodiscard]] std::size_t hit_offset(TileIndex t) const {
        return first_luxel_[t] * (hit_words + surface_words);
    }
    [[nodiscard]] std::size_t surface_offset(TileIndex t) const {
        return hit_offset(t) + luxels(t) * hit_words;
    }
    [[nodiscard]] const std::uint32_t* hit_plane(TileIndex t) const {
        return words_.data() + hit_offset(t);
    }
    [[nodiscard]] const std::uint32_t* surface_plane(TileIndex t) const {
        return words_.data() + surface_offset(t);
    }

    Extent extent_;
    std::vector<Tile> tiles_;
    std::vector<std::size_t> first_luxel_;
    std::vector<std::uint32_t, Alloc> words_;
};

}  // namespace mir
