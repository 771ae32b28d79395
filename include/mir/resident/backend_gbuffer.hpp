// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/data/gbuffer_words.hpp"

#include <string>

namespace mir {

/// Owner of the luxels of an image, or of a band, in a backend's memory. Schedulers over that
/// backend then copy nothing. Same words as a BlockedGBuffer of the same extents. Model of
/// TiledGBuffer. What it holds is undefined until trace_primary_hits() or upload() has filled it.
template <Backend B, class Params>
class BackendGBuffer {
 public:
    /// What a luxel knows of its surface.
    using Surface = mir::Surface<Params>;
    /// Luxels of one tile.
    using View = GBufferView<B::space, Params>;

    /// @throws Error(invalid_argument) when an extent is zero, Error(limit_exceeded) for 2^32
    ///         luxels and more, and what the backend throws when it has no memory left.
    BackendGBuffer(const B& backend, Extent extent, Extent tile_size)
        : tiles_(cut_into_tiles(extent, tile_size)),
          grid_(TileGrid::of(extent, tiles_)),
          words_(backend.template buffer<std::uint32_t>(checked_count(grid_))) {}

    /// Size of the image or band, in luxels.
    [[nodiscard]] Extent extent() const { return grid_.image; }
    /// Row by row; TileIndex counts them.
    [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }
    /// The same tiles as a small value, for kernels.
    [[nodiscard]] const TileGrid& grid() const { return grid_; }

    /// For kernels that read the luxels of a tile; valid as long as this.
    [[nodiscard]] View view(TileIndex t) const {
        const SoaView<const Hit> hits{words_.data() + first_word(t), luxels(t)};
        return {hits, {hits.planes + hit_words(t), luxels(t)}};
    }

    /// Words of a tile for schedulers that copy, which those over the host do (PackedGBuffer).
    [[nodiscard]] std::span<const std::uint32_t> hit_words_of(TileIndex t) const
        requires(B::space == Space::host) {
        return {words_.data() + first_word(t), hit_words(t)};
    }
    /// The same of the surfaces, which follow the hits.
    [[nodiscard]] std::span<const std::uint32_t> surface_words_of(TileIndex t) const
        requires(B::space == Space::host) {
        return {words_.data() + first_word(t) + hit_words(t), tile_words(t) - hit_words(t)};
    }

    /// For kernels that fill it.
    [[nodiscard]] GBufferWords<Params> words() { return {words_.data(), grid_}; }

    /// For kernels that read luxels by their places.
    [[nodiscard]] LuxelImageView<Params> image() const { return {words_.data(), grid_}; }

    /// Starts copying from a G-buffer of the same tiles. It must live until that is done.
    /// @throws Error(invalid_argument) when the tiles are others.
    template <class Alloc>
    void upload(typename B::Queue& queue, const BlockedGBuffer<Params, Alloc>& from) {
        check_fits(from);
        queue.upload(std::span<const std::uint32_t>(from.words()), words_);
    }

    /// Starts copying to a G-buffer of the same tiles. It must live until that is done.
    /// @throws Error(invalid_argument) when the tiles are others.
    template <class Alloc>
    void download(typename B::Queue& queue, BlockedGBuffer<Params, Alloc>& to) const {
        check_fits(to);
        queue.download(words_, std::span<std::uint32_t>(to.words()));
    }

    /// Bytes held, for reports.
    [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint32_t); }

 private:
    using Words = GBufferWords<Params>;

    static std::size_t checked_count(const TileGrid& grid) {
        if (grid.size() > 0xFFFFFFFFu)
            throw Error(ErrorCode::limit_exceeded,
                        std::to_string(grid.size()) +
                            " luxels were asked for in one G-buffer (kernels count them in 32 "
                            "bits); render the image in bands of rows");
        return static_cast<std::size_t>(Words::count(grid));
    }
    template <class Alloc>
    void check_fits(const BlockedGBuffer<Params, Alloc>& other) const {
        expects(other.extent() == extent() && TileGrid::of(other.extent(), other.tiles()) == grid_,
                "a G-buffer was copied to one of other tiles (its luxels would be mixed up); make "
                "both of the same extents");
    }
    [[nodiscard]] std::uint32_t luxels(TileIndex t) const {
        return BlockedLayout::of(tiles_[t]).size();
    }
    [[nodiscard]] std::size_t hit_words(TileIndex t) const {
        return std::size_t{luxels(t)} * SoaView<Hit>::words;
    }
    [[nodiscard]] std::size_t tile_words(TileIndex t) const { return luxels(t) * Words::per_luxel; }
    [[nodiscard]] std::size_t first_word(TileIndex t) const { return Words::first_word(grid_, t); }

    std::vector<Tile> tiles_;
    TileGrid grid_;
    typename B::template Buffer<std::uint32_t> words_;
};

}  // namespace mir
