// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/construction.hpp"
#include "mir/accel/kd/detail/kd_assemble.hpp"
#include "mir/accel/kd/detail/kd_grow.hpp"
#include "mir/accel/kd/detail/kd_prepare.hpp"
#include "mir/accel/kd/detail/kd_top.hpp"
#include "mir/accel/kd/kd_tree.hpp"

#include <cmath>

namespace mir {

namespace detail {

inline std::uint32_t kd_depth(const KdTreeOptions& options, std::size_t triangles) {
    if (options.max_depth > 0) return options.max_depth;
    const double depth = 8.0 + 1.3 * std::log2(static_cast<double>(triangles) + 1.0);
    return std::min(KdTreeOptions::depth_limit, static_cast<std::uint32_t>(depth));
}

/// Size of a subtree that one thread grows. Enough of them for many threads, each large enough to
/// pay for itself. Must not depend on the number of threads, for the tree's bytes do on it.
inline std::size_t kd_subtree_size(std::size_t triangles) {
    return std::max<std::size_t>(4096, triangles / 64);
}

}  // namespace detail

template <Executor E>
KdTree::KdTree(const WorldGeometry& geometry, const KdTreeOptions& options, E& executor) {
    check(options);
    detail::check_coordinates(geometry);
    const std::size_t count = geometry.triangles().size();
    detail::KdPrepared prepared;
    detail::timed(statistics_.prepare_seconds,
                  [&] { prepared = detail::prepare(geometry, triangles_, executor); });
    const detail::KdPlan plan{options, prepared.triangles.data(), detail::kd_depth(options, count),
                              detail::area_scale({prepared.cell.low, prepared.cell.high})};
    detail::KdGrowerPool pool(plan);
    detail::KdTop top;
    detail::timed(statistics_.top_seconds, [&] {
        detail::KdTopGrower grower(plan, pool, detail::kd_subtree_size(count), executor);
        top = grower.grow(std::move(prepared.fragments), prepared.cell);
    });
    std::vector<detail::KdGrown> grown;
    detail::timed(statistics_.subtrees_seconds,
                  [&] { grown = detail::grow_subtrees(top.open, pool, options, executor); });
    detail::timed(statistics_.assemble_seconds,
                  [&] { detail::assemble(top, grown, options, nodes_, references_, executor); });
    for (int axis = 0; axis < 3; ++axis) {
        low_[axis] = prepared.cell.low[axis];
        high_[axis] = prepared.cell.high[axis];
    }
    reach_ = reach_of(magnitude_of(geometry.bounds()));
    count_parts(top.tally, grown);
}

inline void KdTree::count_parts(detail::KdTally total, const std::vector<detail::KdGrown>& grown) {
    for (const detail::KdGrown& part : grown) total.add(part.subtree.tally);
    statistics_.triangles = triangles_.size();
    statistics_.nodes = nodes_.size() - KdTreeView<Space::host>::root;
    statistics_.leaves = total.leaves;
    statistics_.empty_leaves = total.empty_leaves;
    statistics_.references = references_.size();
    statistics_.depth = total.depth;
    statistics_.largest_leaf = total.largest_leaf;
    statistics_.sah_cost = total.cost;
    statistics_.bytes = bytes();
}

}  // namespace mir
