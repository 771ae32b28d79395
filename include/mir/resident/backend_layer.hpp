// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/soa.hpp"
#include "mir/data/tile_grid.hpp"

namespace mir {

/// A colour per luxel of an image, or of a band, for kernels. Tiles and luxels come in the order of
/// a G-buffer, with planes of red, green and blue in each tile. A view; thread-safe.
struct LayerView {
    const std::uint32_t* words = nullptr;  ///< of all tiles, one after the other
    TileGrid grid;                         ///< of the image or band

    /// Colour of the luxel at (x, y).
    [[nodiscard]] MIR_HD Rgb operator()(std::uint32_t x, std::uint32_t y) const {
        const TileIndex t = y / grid.tile.height * grid.columns() + x / grid.tile.width;
        const Tile tile = grid[t];
        const auto layout = BlockedLayout::of(tile);
        const SoaView<const Rgb> colours{words + first_word(grid, t), layout.size()};
        return colours.load(layout(x - tile.x, y - tile.y));
    }

    /// Place of a tile's first word.
    MIR_HD static constexpr std::size_t first_word(const TileGrid& grid, TileIndex t) {
        return std::size_t{grid.first_block(t)} * BlockedLayout::block_size * SoaView<Rgb>::words;
    }
};

/// Owner of what LayerView views in a backend's memory. Undefined until kernels have written it.
template <Backend B>
class BackendLayer {
 public:
    /// @throws What the backend throws when it has no memory left.
    BackendLayer(const B& backend, const TileGrid& grid)
        : grid_(grid),
          words_(backend.template buffer<std::uint32_t>(static_cast<std::size_t>(grid.size()) *
                                                        SoaView<Rgb>::words)) {}

    /// Tiles that it was made for.
    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    /// For kernels that read it; valid as long as this.
    [[nodiscard]] LayerView view() const { return {words_.data(), grid_}; }

    /// The luxels of a tile, for kernels that write them.
    [[nodiscard]] SoaView<Rgb> tile(TileIndex t) {
        return {words_.data() + LayerView::first_word(grid_, t),
                BlockedLayout::of(grid_[t]).size()};
    }
    /// All words, for copies and for kernels that treat luxels alike.
    [[nodiscard]] typename B::template Buffer<std::uint32_t>& words() { return words_; }

 private:
    TileGrid grid_;
    typename B::template Buffer<std::uint32_t> words_;
};

/// Kernel over the luxels of a tile: what they emit themselves.
template <class G>
struct EmissionPass {
    G luxels;          ///< of the tile, a view as kernels read them
    SoaView<Rgb> out;  ///< radiance, W m^-2 sr^-1

    /// Luxel i of the tile, padding included.
    MIR_HD void operator()(LuxelIndex i) const { out.store(i, luxels.surface(i).emission); }
};
template <class G>
EmissionPass(G, SoaView<Rgb>) -> EmissionPass<G>;

/// Kernel over the luxels of a tile: white where they see a surface, black elsewhere.
template <class G>
struct CoveragePass {
    G luxels;          ///< of the tile, a view as kernels read them
    SoaView<Rgb> out;  ///< 0 or 1 in each channel

    /// Luxel i of the tile, padding included.
    MIR_HD void operator()(LuxelIndex i) const {
        out.store(i, is_empty(luxels.hit(i)) ? Rgb{} : Rgb{1, 1, 1});
    }
};
template <class G>
CoveragePass(G, SoaView<Rgb>) -> CoveragePass<G>;

/// Kernel over all luxels of two layers of one grid, padding included: sum += layer.
struct AddLayer {
    SoaView<Rgb> sum;          ///< read and written
    SoaView<const Rgb> layer;  ///< as many luxels as `sum`

    /// Luxel i, counted over all tiles.
    MIR_HD void operator()(std::uint32_t i) const { sum.store(i, sum.load(i) + layer.load(i)); }
};

/// Kernel over the rows of a layer. Adds up the luminance of each, from left to right.
struct RowLuminance {
    LayerView layer;        ///< what is added up
    double* out = nullptr;  ///< a sum per row of the image or band, in the unit of the layer

    /// Row y.
    MIR_HD void operator()(std::uint32_t y) const {
        double sum = 0.0;
        for (std::uint32_t x = 0; x < layer.grid.image.width; ++x)
            sum += static_cast<double>(luminance(layer(x, y)));
        out[y] = sum;
    }
};

}  // namespace mir
