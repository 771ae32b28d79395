// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/resident/word_finder.hpp"

namespace mir {

/// Which luxels face and see which VPL, in a backend's memory. The luxels are those of an image or
/// a band: a bit per pair, a run of words per tile. What it holds is undefined until find() has
/// filled it.
template <Backend B>
class BackendVisibility {
 public:
    /// For G-buffers of these tiles and sets of `vpls` VPLs.
    /// @throws Error(limit_exceeded) when Limits::visibility_bytes is less than bytes_for().
    BackendVisibility(const B& backend, const TileGrid& tiles, std::uint32_t vpls,
                      const Limits& limits = {})
        : grid_(tiles),
          vpls_(vpls),
          words_(backend.template buffer<std::uint32_t>(checked_count(tiles, vpls, limits))),
          finder_(backend, BlockedLayout::of(tiles[0]).size(), vpls) {}

    /// Starts to find which luxels of `gbuffer` and VPLs face and see each other (WordFinder).
    /// Kernels on `queue` that follow may read the words; other queues wait for an event of it.
    /// @throws Error(invalid_argument) when luxels or VPLs are others than it was made for.
    template <TiledGBuffer G, VplSet P, Visibility V>
        requires AccessibleFrom<V, B::space>
    void find(typename B::Queue& queue, const G& gbuffer, P vpls, V visibility) {
        expects(TileGrid::of(gbuffer.extent(), gbuffer.tiles()) == grid_ && vpls.size() == vpls_,
                "visibility was asked for luxels or VPLs that it was not made for (its bits would "
                "not fit); make it from the grid of this G-buffer");
        if (vpls_ == 0) return;
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
            finder_.find(queue, gbuffer.view(t), BlockedLayout::of(gbuffer.tiles()[t]), vpls,
                         visibility, words_.data() + first_word(t));
        }
    }

    /// The words of tile `t`.
    [[nodiscard]] VisibilityWords<B::space> tile(TileIndex t) const {
        return {words_.data() + first_word(t), vpls_};
    }
    /// Number of VPLs that it was made for.
    [[nodiscard]] std::uint32_t vpls() const { return vpls_; }
    /// Tiles that it was made for.
    [[nodiscard]] const TileGrid& grid() const { return grid_; }

    /// Bytes that it takes, before it is made.
    static std::uint64_t bytes_for(const TileGrid& tiles, std::uint32_t vpls) {
        return saturating_mul(tiles.size() / 8, vpls);
    }

 private:
    static std::size_t checked_count(const TileGrid& tiles, std::uint32_t vpls,
                                     const Limits& limits) {
        check_limit(bytes_for(tiles, vpls), limits.visibility_bytes, "visibility_bytes");
        return static_cast<std::size_t>(bytes_for(tiles, vpls) / sizeof(std::uint32_t));
    }
    [[nodiscard]] std::size_t first_word(TileIndex t) const {
        constexpr std::uint32_t words_per_block =
            BlockedLayout::block_size / VisibilityWords<B::space>::width;
        return std::size_t{grid_.first_block(t)} * words_per_block * vpls_;
    }

    TileGrid grid_;
    std::uint32_t vpls_;
    typename B::template Buffer<std::uint32_t> words_;
    WordFinder<B> finder_;
};

}  // namespace mir
