// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/cuts/deviation_cut.hpp"
#include "mir/cuts/gather_cuts.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/resident/backend_layer.hpp"
#include "mir/resident/backend_vpl_tree.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/shading/check_bound.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// reconstruct_cuts() by DeviationCut on a backend. Tree, cuts and luxels are made there. Bits are
/// those of reconstruct_cuts() where host and device round alike and answer rays alike. One thread
/// at a time.
template <Backend B>
class BackendCuts {
 public:
    /// Memory of the cuts that are made at a time, unless those of one block need more.
    static constexpr std::uint64_t default_bytes = std::uint64_t{1} << 28;

    /// Copies the VPLs that shine and makes their tree. Cuts have at most policy.picks nodes, which
    /// are at least 1.
    /// @throws What BackendVplTree throws.
    BackendCuts(const B& backend, VplSpan<Space::host> vpls, const DeviationCut& policy,
                std::uint64_t bytes = default_bytes)
        : backend_(backend),
          queue_(backend.queue()),
          tree_(backend, queue_, vpls),
          floor_(policy.floor),
          room_(std::min(policy.picks, tree_.size())),
          most_blocks_(static_cast<std::uint32_t>(std::clamp<std::uint64_t>(
              bytes / CutTable::bytes_of_block(room_), 1, std::uint64_t{1} << 24))) {}

    /// The radiance of the luxels of an image or band, W m^-2 sr^-1. All work is done when it
    /// returns. `monitor` may be null; it counts pairs of luxel and picked VPL.
    /// @throws Error(invalid_argument) when the shading has a bound that is none (check_bound());
    ///         Error(cancelled).
    template <class Params, Visibility V, Shading F>
    [[nodiscard]] BackendLayer<B> gather(const BackendGBuffer<B, Params>& gbuffer,
                                         const V& visibility, const F& shading,
                                         const CutPlace& place, Monitor* monitor = nullptr) {
        check_shading(shading);
        BackendLayer<B> layer(backend_, gbuffer.grid());
        if (room_ == 0) {
            queue_.clear(layer.words());
            queue_.record().sync();
            return layer;
        }
        Table table(backend_, room_, std::min(most_blocks_, largest_tile(gbuffer)));
        const WaitAtEnd wait(queue_);
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
            const Tile tile = gbuffer.tiles()[t];
            const std::uint32_t blocks = BlockedLayout::of(tile).blocks();
            for (std::uint32_t first = 0; first < blocks; first += table.blocks()) {
                if (monitor != nullptr) monitor->check();
                const std::uint32_t n = std::min(table.blocks(), blocks - first);
                const auto luxels = gbuffer.view(t);
                queue_.for_each_group(
                    n, ChooseCuts{luxels, tree_.view(), shading, floor_, first, table.view()});
                const GatherCuts gathering{luxels, tile,  tree_.view(), visibility,   shading,
                                           place,  first, table.view(), layer.tile(t)};
                queue_.for_each_group(n * gathering.groups_of_block, gathering);
                if (monitor != nullptr)
                    monitor->contributions += table.pairs(queue_, tile, first, n);
            }
        }
        queue_.record().sync();
        return layer;
    }

 private:
    /// Owner of a CutTable.
    class Table {
     public:
        Table(const B& backend, std::uint32_t room, std::uint32_t blocks)
            : room_(room),
              nodes_(backend.template buffer<VplNode>(std::size_t{blocks} * room)),
              sizes_(backend.template buffer<std::uint32_t>(blocks)),
              lists_(backend.template buffer<GrowingCut::Listed>(std::size_t{blocks} * room)),
              heaps_(backend.template buffer<GrowingCut::Ranked>(std::size_t{blocks} * room)) {}

        [[nodiscard]] std::uint32_t blocks() const {
            return static_cast<std::uint32_t>(sizes_.size());
        }
        [[nodiscard]] CutTable view() {
            return {nodes_.data(), sizes_.data(), lists_.data(), heaps_.data(), room_};
        }
        /// Pairs of luxel and pick in `n` blocks of a tile, the first of the table. Waits.
        [[nodiscard]] std::uint64_t pairs(typename B::Queue& queue, const Tile& tile,
                                          std::uint32_t first, std::uint32_t n) {
            std::vector<std::uint32_t> sizes(n);
            queue.download(sizes_, std::span(sizes));
            queue.record().sync();
            std::uint64_t sum = 0;
            for (std::uint32_t i = 0; i < n; ++i) {
                const Tile area = BlockedLayout::of(tile).block_area(tile, first + i);
                sum += std::uint64_t{area.width} * area.height * sizes[i];
            }
            return sum;
        }

     private:
        std::uint32_t room_;
        typename B::template Buffer<VplNode> nodes_;
        typename B::template Buffer<std::uint32_t> sizes_;
        typename B::template Buffer<GrowingCut::Listed> lists_;
        typename B::template Buffer<GrowingCut::Ranked> heaps_;
    };

    template <class G>
    [[nodiscard]] static std::uint32_t largest_tile(const G& gbuffer) {
        std::uint32_t most = 1;
        for (const Tile& tile : gbuffer.tiles())
            most = std::max(most, BlockedLayout::of(tile).blocks());
        return most;
    }

    B backend_;
    typename B::Queue queue_;
    BackendVplTree<B> tree_;
    float floor_;
    std::uint32_t room_;
    std::uint32_t most_blocks_;
};

}  // namespace mir
