// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/cluster.hpp"
#include "mir/accel/detail/slot_costs.hpp"

namespace mir::detail {

/// Whether cluster i and the partner that it found want each other.
MIR_HD inline bool is_pair(const std::uint32_t* partners, std::uint32_t i) {
    return partners[i] != i && partners[partners[i]] == i;
}

/// Kernel over clusters and one index more, so that sums of what it writes include all: 1 where a
/// cluster keeps a place, 0 for the second of a pair.
struct MarkKept {
    const std::uint32_t* partners = nullptr;
    std::uint32_t* kept = nullptr;
    std::uint32_t count = 0;

    MIR_HD void operator()(std::uint32_t i) const {
        const bool goes = i == count || (is_pair(partners, i) && partners[i] < i);
        kept[i] = goes ? 0 : 1;
    }
};

/// Kernel over clusters and one index more: joins pairs, closes the gaps and counts what is left.
/// Nodes are numbered in the order of the clusters that go.
struct JoinClusters {
    const Cluster* clusters = nullptr;
    const std::uint32_t* partners = nullptr;
    const std::uint32_t* kept_before = nullptr;
    BinaryNode* nodes = nullptr;
    SlotCosts* costs = nullptr;
    Cluster* next = nullptr;
    std::uint32_t* next_count = nullptr;  ///< one word
    std::uint32_t count = 0;
    std::uint32_t first_node = 0;  ///< of those made here
    std::uint32_t leaf_size = 0;
    float area_scale = 0.0f;

    MIR_HD void operator()(std::uint32_t i) const {
        if (i == count) {
            *next_count = kept_before[i];
        } else if (!is_pair(partners, i)) {
            next[kept_before[i]] = clusters[i];
        } else if (i < partners[i]) {
            next[kept_before[i]] = join(clusters[i], clusters[partners[i]], partners[i]);
        }
    }

 private:
    [[nodiscard]] MIR_HD Cluster join(const Cluster& a, const Cluster& b,
                                      std::uint32_t goes) const {
        const Cluster both = joined(a, b, first_node + (goes - kept_before[goes]));
        const BinaryNode& left = nodes[a.node];
        const BinaryNode& right = nodes[b.node];
        const std::uint32_t triangles = left.count + right.count;
        const std::uint32_t taller = left.height > right.height ? left.height : right.height;
        nodes[both.node] = {both.low, both.high, a.node,
                            b.node,   triangles, triangles <= leaf_size ? 0 : taller + 1};
        costs[both.node] =
            joined_costs(costs[a.node], costs[b.node], half_area(both.low, both.high, area_scale),
                         triangles, leaf_size);
        return both;
    }
};

}  // namespace mir::detail
