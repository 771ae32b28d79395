// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace mir {

/// How luxels are put into clusters.
struct ClusterOrderOptions {
    /// What a difference of 1 in a component of the normal counts as, in diagonals of the box
    /// around the luxels; 0 ignores normals.
    float normal_weight = 0.01f;
};

namespace detail {

/// By what luxels are told apart: position and weighted normal, metres.
using ClusterKey = std::array<float, 6>;

/// Part of an order.
struct ClusterRun {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// Runs of this size are split no more: the smallest that anything decides at once.
inline constexpr std::size_t smallest_cluster = 16;

/// Elements of the first part of a run: the largest 16 2^k below its size, so that every aligned
/// run of that many luxels is one part of the recursion.
inline std::size_t first_part(std::size_t count) {
    std::size_t part = smallest_cluster;
    while (2 * part < count) part *= 2;
    return part;
}

/// Order of the luxels that are not empty, while it is made.
class ClusterSplitter {
 public:
    ClusterSplitter(const std::vector<ClusterKey>& keys, std::vector<std::uint32_t>& order)
        : keys_(&keys), order_(&order) {}

    /// Puts the luxels of a run with the smaller keys in its first part. Equal keys go by index:
    /// what the parts hold is then a function of the luxels alone.
    [[nodiscard]] std::array<ClusterRun, 2> split(ClusterRun run) const {
        const std::size_t k = widest(run);
        const std::size_t part = first_part(run.count);
        const auto begin = order_->begin() + static_cast<std::ptrdiff_t>(run.first);
        std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(part),
                         begin + static_cast<std::ptrdiff_t>(run.count),
                         [this, k](std::uint32_t a, std::uint32_t b) {
                             const float at_a = (*keys_)[a][k];
                             const float at_b = (*keys_)[b][k];
                             return at_a != at_b ? at_a < at_b : a < b;
                         });
        return {{{run.first, part}, {run.first + part, run.count - part}}};
    }

    /// Splits a run to the end. The smallest runs are sorted by index, since selection leaves them
    /// in an order that depends on the standard library.
    void split_all(ClusterRun run) const {
        if (run.count <= smallest_cluster) {
            const auto begin = order_->begin() + static_cast<std::ptrdiff_t>(run.first);
            std::sort(begin, begin + static_cast<std::ptrdiff_t>(run.count));
            return;
        }
        for (const ClusterRun part : split(run)) split_all(part);
    }

 private:
    /// The key with the largest extent in a run, the first of equals.
    [[nodiscard]] std::size_t widest(ClusterRun run) const {
        ClusterKey low = (*keys_)[(*order_)[run.first]];
        ClusterKey high = low;
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            const ClusterKey& key = (*keys_)[(*order_)[i]];
            for (std::size_t k = 0; k < key.size(); ++k) {
                low[k] = std::min(low[k], key[k]);
                high[k] = std::max(high[k], key[k]);
            }
        }
        std::size_t widest = 0;
        for (std::size_t k = 1; k < low.size(); ++k)
            if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
        return widest;
    }

    const std::vector<ClusterKey>* keys_;
    std::vector<std::uint32_t>* order_;
};

/// Splits large runs level by level, those of a level at the same time, small ones to the end.
template <Executor E>
void split_in_levels(const ClusterSplitter& splitter, ClusterRun all, E& executor) {
    constexpr std::size_t small = 8192;
    std::vector<ClusterRun> runs{all};
    while (!runs.empty()) {
        std::vector<ClusterRun> parts(2 * runs.size());
        executor.for_each(runs.size(), [&](std::size_t i) {
            if (runs[i].count <= small) return splitter.split_all(runs[i]);
            const auto halves = splitter.split(runs[i]);
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
/// the same way: place i is for luxel order[i]. Recursive median split along the widest of six
/// keys, position and weighted normal; empty luxels come last, in their order. A function of the
/// luxels (finite numbers) and the options alone, whatever the executor does. It decides speed,
/// never bits.
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
