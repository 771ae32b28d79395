// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"
#include "support/shafts/cluster_splitter.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// How luxels are put into clusters.
struct ClusterOrderOptions {
    /// What a difference of 1 in a component of the normal counts as, in diagonals of the box
    /// around the luxels; 0 ignores normals.
    float normal_weight = 0.01f;
};

namespace detail {

/// Splits large runs level by level, all cuts of a level at the same time, small ones to the end.
template <Executor E>
void split_in_levels(const ClusterSplitter& splitter, ClusterRun all, E& executor) {
    constexpr std::size_t cuts = ClusterSplitter::cuts;
    const auto is_small = [](ClusterRun run) { return run.count <= 8192; };
    std::vector<ClusterRun> runs{all};
    while (!runs.empty()) {
        std::vector<ClusterCut> tried(cuts * runs.size());
        executor.for_each(tried.size(), [&](std::size_t i) {
            const ClusterRun run = runs[i / cuts];
            if (!is_small(run)) tried[i] = splitter.cut(run, i % cuts);
        });
        std::vector<ClusterRun> parts(2 * runs.size());
        executor.for_each(runs.size(), [&](std::size_t i) {
            if (is_small(runs[i])) return splitter.split_all(runs[i]);
            const auto halves = splitter.split(runs[i], &tried[cuts * i]);
            std::copy(halves.begin(), halves.end(),
                      parts.begin() + 2 * static_cast<std::ptrdiff_t>(i));
        });
        std::erase_if(parts, [](ClusterRun r) { return r.count == 0; });
        runs.swap(parts);
    }
}

inline std::vector<ClusterKey> cluster_keys(const SoaView<const Hit>& luxels,
                                            const std::vector<std::uint32_t>& used, float weight) {
    std::vector<ClusterKey> keys(luxels.stride);
    for (const std::uint32_t i : used) {
        const Hit h = luxels.load(i);
        const Vec3 n = weight * h.normal;
        keys[i] = {h.position.x, h.position.y, h.position.z, n.x, n.y, n.z};
    }
    return keys;
}

/// Diagonal of the box around some luxels, metres.
inline float diagonal_of(const SoaView<const Hit>& luxels, const std::vector<std::uint32_t>& used) {
    if (used.empty()) return 0.0f;
    Vec3 low = luxels.load(used.front()).position;
    Vec3 high = low;
    for (const std::uint32_t i : used) {
        low = glm::min(low, luxels.load(i).position);
        high = glm::max(high, luxels.load(i).position);
    }
    return glm::length(high - low);
}

}  // namespace detail

/// An order of luxels in which every aligned run of 16, 32, 64, ... lies close together and looks
/// the same way: place i is for luxel order[i]. Recursive median split: of seven cuts, by each of
/// six keys, position and weighted normal, and along the principal axis of the keys, the one that
/// leaves the smallest boxes; empty luxels come last, in their order. A function of the luxels
/// (finite numbers) and the options alone, whatever the executor does. It decides speed, never
/// bits.
template <Executor E>
[[nodiscard]] std::vector<std::uint32_t> cluster_order(const SoaView<const Hit>& luxels,
                                                       const ClusterOrderOptions& options,
                                                       E& executor) {
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> empty;
    for (std::uint32_t i = 0; i < luxels.stride; ++i)
        (is_empty(luxels.load(i)) ? empty : order).push_back(i);
    const float weight = options.normal_weight * detail::diagonal_of(luxels, order);
    const auto keys = detail::cluster_keys(luxels, order, weight);
    const detail::ClusterSplitter splitter(keys, order);
    if (!order.empty()) detail::split_in_levels(splitter, {0, order.size()}, executor);
    order.insert(order.end(), empty.begin(), empty.end());
    return order;
}

}  // namespace mir
