// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/quantised_bvh.hpp"
#include "mir/shaft/device/leaf_search.hpp"
#include "mir/shaft/device/work_queue.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

namespace mir {

/// A few pairs of 32 luxels and a VPL, with their leaves' triangles. A group works on them
/// together, one pair's triangles behind the other's: lanes that one pair leaves without a triangle
/// have one of the next.
struct ListBatch {
    static constexpr std::uint32_t most_lists = 8;        ///< pairs
    static constexpr std::uint32_t most_triangles = 224;  ///< of all pairs

    std::uint32_t lists = 0;                     ///< pairs
    std::uint32_t triangles = 0;                 ///< of all
    LaneGroup::PerLane<std::uint32_t> clusters;  ///< lane k < lists: cluster of the k-th pair
    LaneGroup::PerLane<std::uint32_t> vpls;      ///< lane k < lists: its VPL
    /// Lane k: where the triangles of the k-th pair end; ~0 from `lists` on.
    LaneGroup::PerLane<std::uint32_t> ends;

    /// For each lane the number of the pair that has triangle first + lane. Pairs without it count
    /// not.
    [[nodiscard]] MIR_HD LaneGroup::PerLane<std::uint32_t> lists_from(const LaneGroup& group,
                                                                      std::uint32_t first) const {
        LaneGroup::PerLane<std::uint32_t> list;
        group.each([&](std::uint32_t lane) { list[lane] = 0; });
        for (std::uint32_t k = 0; k + 1 < lists; ++k) {
            const std::uint32_t end = group.broadcast(ends, k);
            group.each([&](std::uint32_t lane) { list[lane] += first + lane >= end ? 1u : 0u; });
        }
        return list;
    }
};

namespace detail {

/// A node of some list for each lane.
struct BatchNodes {
    std::uint32_t lists = 0;                 ///< that have all their nodes here
    std::uint32_t count = 0;                 ///< nodes
    LaneGroup::PerLane<std::uint32_t> at;    ///< place of the lane's node in the pool
    LaneGroup::PerLane<std::uint32_t> ends;  ///< lane k < lists: where the nodes of list k end
};

/// As many of the lists from `listed` on as have 32 nodes together. There are `count` > 0.
MIR_HD inline BatchNodes nodes_of_batch(const LaneGroup& group, const ListedPair* listed,
                                        std::uint32_t count, ListBatch& batch) {
    LaneGroup::PerLane<std::uint32_t> firsts;
    LaneGroup::PerLane<std::uint32_t> sizes;
    BatchNodes nodes;
    group.each([&](std::uint32_t lane) {
        const bool is_own = lane < count && lane < ListBatch::most_lists;
        const ListedPair list = listed[is_own ? lane : 0];
        batch.clusters[lane] = list.pair.cluster;
        batch.vpls[lane] = list.pair.vpl;
        firsts[lane] = list.first;
        sizes[lane] = is_own ? list.count : LaneGroup::width + 1;
        nodes.at[lane] = 0;
        nodes.ends[lane] = LaneGroup::width;
    });
    for (std::uint32_t k = 0; k < ListBatch::most_lists; ++k) {
        const std::uint32_t end = nodes.count + group.broadcast(sizes, k);
        if (end > LaneGroup::width) break;
        const std::uint32_t from = group.broadcast(firsts, k) - nodes.count;
        group.each([&](std::uint32_t lane) {
            if (lane >= nodes.count) nodes.at[lane] = from + lane;
            if (lane == k) nodes.ends[lane] = end;
        });
        nodes.count = end;
        nodes.lists = k + 1;
    }
    return nodes;
}

}  // namespace detail

/// Fills a batch with the first lists from `listed` on. There are `count` > 0. `triangles`, which
/// has room for most_triangles of a batch, gets the triangles of their leaves by their place in the
/// hierarchy. Takes as many lists as fit, each of at most 32 nodes: none, when the first one has
/// too many triangles.
template <Space S>
MIR_HD void unpack_lists(const LaneGroup& group, const QuantisedBvhView<S>& bvh,
                         const std::uint32_t* pool, const ListedPair* listed, std::uint32_t count,
                         ListBatch& batch, std::uint32_t* triangles) {
    const detail::BatchNodes nodes = detail::nodes_of_batch(group, listed, count, batch);
    LaneGroup::PerLane<LeafTriangles> leaves;
    LaneGroup::PerLane<std::uint32_t> place;
    group.each([&](std::uint32_t lane) {
        const MetLeaves met = lane < nodes.count ? MetLeaves{pool[nodes.at[lane]]} : MetLeaves{};
        leaves[lane] = bvh.links[met.node()].leaves(met.slots());
        place[lane] = leaves[lane].count();
    });
    const std::uint32_t total = group.sums_before(place);
    LaneGroup::PerLane<std::uint32_t> behind;
    group.each([&](std::uint32_t lane) { behind[lane] = nodes.ends[lane] % LaneGroup::width; });
    batch.ends = group.gather(place, behind);
    batch.lists = LaneGroup::count(group.ballot([&](std::uint32_t lane) {
        if (nodes.ends[lane] == LaneGroup::width) batch.ends[lane] = total;
        const bool fits = lane < nodes.lists && batch.ends[lane] <= ListBatch::most_triangles;
        if (!fits) batch.ends[lane] = 0xFFFFFFFFu;
        return fits;
    }));
    batch.triangles = batch.lists > 0 ? group.broadcast(batch.ends, batch.lists - 1) : 0;
    group.each([&](std::uint32_t lane) {
        if (place[lane] >= batch.triangles) return;
        std::uint32_t* out = triangles + place[lane];
        leaves[lane].for_each([&](std::uint32_t triangle) { *out++ = triangle; });
    });
}

/// Fills a batch with the clusters of a block from number `first` on. As many as fit; `triangles`
/// is filled as unpack_lists() does: each has those of the block's list, which are 1 to 32 single
/// ones.
MIR_HD inline void share_list(const LaneGroup& group, const std::uint32_t* pool,
                              const ListedPair& block, std::uint32_t first, ListBatch& batch,
                              std::uint32_t* triangles) {
    constexpr std::uint32_t clusters = block_luxels / cluster_luxels;
    static_assert(clusters <= ListBatch::most_lists);
    static_assert(LaneGroup::width <= ListBatch::most_triangles);
    const std::uint32_t size = block.count;
    const std::uint32_t fitting = ListBatch::most_triangles / size;
    batch.lists = clusters - first < fitting ? clusters - first : fitting;
    batch.triangles = batch.lists * size;
    group.each([&](std::uint32_t lane) {
        batch.clusters[lane] = block.pair.cluster * clusters + first + lane;
        batch.vpls[lane] = block.pair.vpl;
        batch.ends[lane] = lane < batch.lists ? (lane + 1) * size : 0xFFFFFFFFu;
        if (lane >= size) return;
        const std::uint32_t triangle = pool[block.first + lane];
        for (std::uint32_t k = 0; k < batch.lists; ++k) triangles[k * size + lane] = triangle;
    });
}

}  // namespace mir
