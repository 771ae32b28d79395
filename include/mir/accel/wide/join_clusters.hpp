// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/cluster.hpp"
#include "mir/accel/wide/detail/slot_costs.hpp"

namespace mir::detail {

/// Whether cluster i and the partner that it found want each other.
MIR_HD inline bool is_pair(const std::uint32_t* partners, std::uint32_t i) {
    return partners[i] != i && partners[partners[i]] == i;
}

/// Kernel over clusters: 1 where a cluster keeps a place, else 0. That is for the second of a pair
/// and for what is no cluster. One index more makes sums of what it writes include all.
struct MarkKept {
    const std::uint32_t* left = nullptr;  ///< how many clusters there are
    const std::uint32_t* partners = nullptr;
    std::uint32_t* kept = nullptr;

    MIR_HD void operator()(std::uint32_t i) const {
        const bool goes = i >= *left || (is_pair(partners, i) && partners[i] < i);
        kept[i] = goes ? 0 : 1;
    }
};

/// Kernel over clusters and one index more. Joins pairs, closes the gaps and counts what is left.
/// Nodes are numbered in the order of the clusters that go.
struct JoinClusters {
    const Cluster* clusters = nullptr;
    const std::uint32_t* left = nullptr;  ///< how many clusters there are
    const std::uint32_t* partners = nullptr;
    const std::uint32_t* kept_before = nullptr;
    BinaryNode* nodes = nullptr;
    SlotCosts* costs = nullptr;
    Cluster* next = nullptr;
    std::uint32_t* next_left = nullptr;
    std::uint32_t references = 0;
    CostRule rule;

    MIR_HD void operator()(std::uint32_t i) const {
        if (i > *left) return;
        if (i == *left) {
            *next_left = kept_before[i];
        } else if (!is_pair(partners, i)) {
            next[kept_before[i]] = clusters[i];
        } else if (i < partners[i]) {
            const Cluster& a = clusters[i];
            const Cluster& b = clusters[partners[i]];
            const Cluster both = joined(a, b, node_without(partners[i]));
            next[kept_before[i]] = both;
            write_node(both, a.node, b.node);
        }
    }

 private:
    /// Number of the node for which a cluster goes. Clusters and the nodes above leaves made so far
    /// are as many as references.
    [[nodiscard]] MIR_HD std::uint32_t node_without(std::uint32_t cluster) const {
        return 2 * references - *left + (cluster - kept_before[cluster]);
    }

    /// Two parts of one triangle become one leaf again.
    MIR_HD void write_node(const Cluster& both, std::uint32_t a, std::uint32_t b) const {
        const float area = rule.area(both.low, both.high);
        if (nodes[a].count == 1 && nodes[b].count == 1 && nodes[a].left == nodes[b].left) {
            nodes[both.node] = {both.low, both.high, nodes[a].left, 0, 1, 0};
            costs[both.node] = triangle_costs(area);
            return;
        }
        const std::uint32_t count = nodes[a].count + nodes[b].count;
        const std::uint32_t taller =
            nodes[a].height > nodes[b].height ? nodes[a].height : nodes[b].height;
        const std::uint32_t height = count <= rule.leaf_size ? 0 : taller + 1;
        nodes[both.node] = {both.low, both.high, a, b, count, height};
        costs[both.node] = joined_costs(costs[a], costs[b], area, count, rule);
    }
};

}  // namespace mir::detail
