// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_top.hpp"

#include <atomic>

namespace mir::detail {

/// A subtree and who holds it.
struct KdGrown {
    KdSubtree subtree;
    const KdGrower* grower = nullptr;

    [[nodiscard]] std::span<const KdNode> nodes() const { return grower->nodes(subtree); }
    [[nodiscard]] std::span<const std::uint32_t> references() const {
        return grower->references(subtree);
    }
};

// Not a template, so that the loops are compiled once for any number of executors.
inline KdSubtree grow_subtree(const KdOpenNode& node, KdGrower& grower) {
    KdSubtree subtree;
    run_with(best_instruction_set(),
             [&] { subtree = grower.grow(node.fragments.span(), node.cell, node.depth); });
    return subtree;
}

/// Grows the subtrees of all open nodes, the largest first. No thread is left with a large one at
/// the end. In the order of `open`, whose fragments are given up.
template <Executor E>
std::vector<KdGrown> grow_subtrees(std::vector<KdOpenNode>& open, KdGrowerPool& pool,
                                   const KdTreeOptions& options, E& executor) {
    std::vector<std::size_t> order(open.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return open[a].fragments.size() > open[b].fragments.size();
    });
    std::vector<KdGrown> grown(open.size());
    std::atomic<std::size_t> next{0};
    std::atomic<std::uint64_t> references{0};
    // Executors may deal indices in any order: they are ignored.
    executor.for_each(open.size(), [&](std::size_t) {
        const std::size_t i = order[next.fetch_add(1)];
        KdOpenNode& node = open[i];
        KdGrower& grower = pool.take();
        grown[i] = {grow_subtree(node, grower), &grower};
        node.fragments = {};
        check_kd_size(0, references += grown[i].subtree.references, options);
        pool.give_back(grower);
    });
    return grown;
}

}  // namespace mir::detail
