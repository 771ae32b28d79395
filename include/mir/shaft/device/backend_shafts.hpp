// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/shaft/device/block_shafts.hpp"
#include "mir/shaft/device/cluster_lists.hpp"
#include "mir/shaft/device/cluster_shafts.hpp"
#include "mir/shaft/device/cluster_visibility.hpp"
#include "mir/shaft/device/facing_pass.hpp"
#include "mir/shaft/device/group_records.hpp"
#include "mir/shaft/device/open_segments.hpp"
#include "mir/shaft/device/page_order.hpp"
#include "mir/shaft/device/page_words.hpp"
#include "mir/shaft/device/veil_shafts.hpp"

#include <algorithm>
#include <optional>

namespace mir {

/// What searches of shafts may cost, and how many pairs a batch has. Any numbers give the same
/// bits.
struct BackendShaftOptions {
    std::uint32_t block_nodes = 16;     ///< that the shaft of 256 luxels and a VPL visits
    std::uint32_t cluster_nodes = 128;  ///< that the shaft of 32 luxels and a VPL visits
    std::uint32_t vpls = 256;  ///< at a time, at least 1: queues have room for all their pairs
    std::uint32_t groups = 1u << 14;  ///< that empty a queue together, at least 1
    std::uint32_t leaves = 1u << 26;  ///< room for the leaves that shafts meet, 4 bytes each
    /// What a difference of 1 in a normal counts as in clusters. In reaches of the
    /// hierarchy.
    float normal_weight = 0.02f;
};

/// Fills words of visibility on a backend by shafts. The better neighbours lie together, the
/// faster. Holds the memory between the stages: 35 bytes for each 32 luxels and each VPL of a batch
/// at most; 24 of them are for leaves and stop growing at BackendShaftOptions::leaves; and 32 bytes
/// for each luxel. One queue at a time.
template <Backend B>
class BackendShafts {
 public:
    /// For up to `luxels` luxels and sets of up to `vpls` VPLs. `luxels` is a multiple of 256.
    /// @throws Error(invalid_argument) on options out of range; what the backend throws when it
    ///         has no memory left.
    BackendShafts(const B& backend, std::uint32_t luxels, std::uint32_t vpls,
                  const BackendShaftOptions& options = {})
        : options_(fitted(options, luxels)),
          luxels_(luxels),
          vpls_(vpls),
          blocks_(backend.template buffer<ClusterRecord>(luxels / block_luxels)),
          clusters_(backend.template buffer<ClusterRecord>(luxels / cluster_luxels)),
          facing_(backend.template buffer<FacingRecord>(luxels / block_luxels)),
          faced_(backend.template buffer<std::uint8_t>(pairs(luxels / block_luxels, vpls))),
          open_blocks_(backend.template buffer<OpenPair>(pairs(luxels / block_luxels, vpls))),
          open_clusters_(backend.template buffer<OpenPair>(pairs(luxels / cluster_luxels, vpls))),
          leaves_(backend.template buffer<std::uint32_t>(
              std::min<std::size_t>(options_.leaves, 4 * open_clusters_.size()))),
          listed_blocks_(backend.template buffer<ListedPair>(open_blocks_.size() / 2)),
          listed_(backend.template buffer<ListedPair>(leaves_.size() / 8)),
          ordered_(backend.template buffer<std::uint32_t>(hit_words * luxels)),
          places_(backend.template buffer<std::uint32_t>(luxels)),
          counters_(backend.template buffer<std::uint32_t>(9)) {}

    /// Starts to fill the words (VisibilityWords) of all pairs of `hits` and `vpls`. Bit for bit
    /// what VisibilityPass and fill_bits() give with visibility.visible(). `hits` are padded with
    /// empty ones. With the layout of their tile they are in blocked order, and put into clusters
    /// while it works; without one they are taken as they are.
    /// @throws Error(invalid_argument) when `hits` are no multiple of 256, or not as many as the
    ///         layout says, or more than it was made for, or VPLs are.
    template <VplSet P, ShaftableVisibility V>
        requires AccessibleFrom<V, B::space>
    void fill(typename B::Queue& queue, SoaView<const Hit> hits,
              const std::optional<BlockedLayout>& layout, P vpls, const V& visibility,
              std::uint32_t* words) {
        expects(hits.stride % block_luxels == 0 && hits.stride <= luxels_ && vpls.size() <= vpls_,
                "shafts were asked for luxels or VPLs that they have no room for, or for a part of "
                "a block of 256; make them for as many, and pad the luxels");
        expects(!layout || layout->size() == hits.stride,
                "shafts were asked for luxels that are not those of their tile's layout; give that "
                "of the tile, or none");
        if (layout) hits = in_clusters(queue, hits, {*layout}, visibility.bvh.exact.reach);
        queue.for_each_group(
            GroupRecords::groups(hits.stride),
            GroupRecords{hits, visibility.sigma, blocks_.data(), clusters_.data()});
        queue.for_each_group(FacingRecords::groups(hits.stride),
                             FacingRecords{hits, facing_.data()});
        for (std::uint32_t first = 0; first < vpls.size(); first += options_.vpls)
            fill_batch(queue, hits, vpls, visibility,
                       {first, std::min(options_.vpls, vpls.size() - first)}, words);
        if (layout) restore_order(queue, {*layout}, vpls.size(), words);
    }

 private:
    static constexpr std::size_t hit_words = SoaView<Hit>::words;

    /// The options with few enough VPLs at a time that 32 bits count leaves.
    [[nodiscard]] static BackendShaftOptions fitted(BackendShaftOptions options,
                                                    std::uint32_t luxels) {
        constexpr std::uint32_t most_pairs = 1u << 27;
        expects(options.vpls >= 1 && options.groups >= 1,
                "shafts were to work on no VPL, or by no group, at a time; choose 1 or more");
        options.vpls = std::min(options.vpls, most_pairs / std::max(luxels / cluster_luxels, 1u));
        return options;
    }
    [[nodiscard]] std::size_t pairs(std::uint32_t runs, std::uint32_t vpls) const {
        return std::size_t{runs} * std::min(options_.vpls, vpls);
    }

    template <class P, class V>
    void fill_batch(typename B::Queue& queue, SoaView<const Hit> hits, P vpls, const V& visibility,
                    // Kernels write to it. NOLINTNEXTLINE(readability-non-const-parameter)
                    VplBatch batch, std::uint32_t* words) {
        constexpr Space space = B::space;
        const FacedBlocks faced{faced_.data(), hits.stride / block_luxels};
        queue.clear(counters_);
        std::uint32_t* counter = counters_.data();
        const WorkQueue<OpenPair> blocks{open_blocks_.data(), size_of(open_blocks_), counter,
                                         counter + 1};
        const WorkQueue<ListedPair> listed{listed_.data(), size_of(listed_), counter + 2,
                                           counter + 3};
        const WorkQueue<OpenPair> open{open_clusters_.data(), size_of(open_clusters_), counter + 4,
                                       counter + 5};
        const LeafPool pool{leaves_.data(), size_of(leaves_), counter + 6};
        const WorkQueue<ListedPair> listed_blocks{listed_blocks_.data(), size_of(listed_blocks_),
                                                  counter + 7, counter + 8};
        queue.for_each_group(FacingPass<P>::groups(hits.stride, batch),
                             FacingPass{hits, facing_.data(), vpls, batch, words, faced});
        queue.for_each_group(
            BlockShafts<space, P>::groups(faced.blocks, batch),
            BlockShafts<space, P>{blocks_.data(), vpls, batch, visibility.bvh, visibility.sigma,
                                  options_.block_nodes, faced, words, listed_blocks, pool, blocks});
        queue.for_each_group(
            options_.groups,
            ClusterShafts<space, P>{clusters_.data(), vpls, visibility.bvh, visibility.sigma,
                                    options_.cluster_nodes, words, blocks, listed, pool, open});
        queue.for_each_group(
            options_.groups,
            ClusterLists<space, P>{hits, clusters_.data(), vpls, visibility.bvh, visibility.sigma,
                                   words, listed_blocks, listed, pool.words, open});
        queue.for_each_group(options_.groups,
                             OpenSegments{hits, vpls, visibility.segments, words, open});
        if constexpr (VeiledVisibility<V>)
            queue.for_each_group(
                VeilShafts<P, decltype(visibility.veil)>::groups(hits.stride, batch),
                VeilShafts<P, decltype(visibility.veil)>{hits, clusters_.data(), vpls, batch,
                                                         visibility.veil_bvh, visibility.sigma,
                                                         visibility.veil, words});
    }

    SoaView<const Hit> in_clusters(typename B::Queue& queue, SoaView<const Hit> hits,
                                   const LuxelPages& pages, float reach) {
        const SoaView<Hit> ordered{ordered_.data(), hits.stride};
        queue.for_each_group(pages.count(), PageOrder{hits, pages, options_.normal_weight * reach,
                                                      ordered, places_.data()});
        return {ordered_.data(), hits.stride};
    }
    void restore_order(typename B::Queue& queue, const LuxelPages& pages, std::uint32_t vpls,
                       // Kernels write to it. NOLINTNEXTLINE(readability-non-const-parameter)
                       std::uint32_t* words) {
        queue.for_each_group(PageWords::groups(pages, vpls),
                             PageWords{pages, places_.data(), vpls, words});
    }

    template <class Buffer>
    [[nodiscard]] static std::uint32_t size_of(const Buffer& buffer) {
        return static_cast<std::uint32_t>(buffer.size());
    }

    BackendShaftOptions options_;
    std::uint32_t luxels_;
    std::uint32_t vpls_;
    typename B::template Buffer<ClusterRecord> blocks_;
    typename B::template Buffer<ClusterRecord> clusters_;
    typename B::template Buffer<FacingRecord> facing_;
    typename B::template Buffer<std::uint8_t> faced_;  ///< FacedBlocks of a batch
    typename B::template Buffer<OpenPair> open_blocks_;
    typename B::template Buffer<OpenPair> open_clusters_;
    typename B::template Buffer<std::uint32_t> leaves_;
    typename B::template Buffer<ListedPair> listed_blocks_;
    typename B::template Buffer<ListedPair> listed_;
    typename B::template Buffer<std::uint32_t> ordered_;  ///< hits, in planes
    typename B::template Buffer<std::uint32_t> places_;
    typename B::template Buffer<std::uint32_t> counters_;
};

}  // namespace mir
