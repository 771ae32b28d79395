// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/wide_grow.hpp"
#include "mir/accel/wide_bvh.hpp"

namespace mir {

namespace detail {

/// Size of a subtree that one thread grows. Must not depend on the number of threads, for the
/// tree's bytes do on it.
inline std::size_t wide_subtree_size(std::size_t triangles) {
    return std::max<std::size_t>(4096, triangles / 64);
}

/// A part of the tree that one thread grew.
struct WidePart {
    std::vector<WideNode> nodes;
    WideTally tally;
};

inline WidePart grow_part(const WidePlan& plan, const WideJob& job) {
    InlineExecutor alone;
    WideGrower<InlineExecutor> grower(plan, 0, alone);
    grower.grow(job.range, job.depth);
    return {std::move(grower.nodes()), grower.tally()};
}

/// Puts `parts`, which hang where `jobs` say, behind the nodes of the top.
template <Executor E>
void assemble(std::vector<WideNode>& nodes, const std::vector<WideJob>& jobs,
              const std::vector<WidePart>& parts, E& executor) {
    std::vector<std::size_t> places(parts.size());
    std::size_t end = nodes.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        places[i] = end;
        nodes[jobs[i].parent].ref[jobs[i].slot] = static_cast<std::uint32_t>(end);
        end += parts[i].nodes.size();
    }
    nodes.resize(end);
    executor.for_each(parts.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < parts[i].nodes.size(); ++k) {
            WideNode node = parts[i].nodes[k];
            for (std::uint32_t slot = 0; slot < WideNode::width; ++slot)
                if (node.is_inner(slot)) node.ref[slot] += static_cast<std::uint32_t>(places[i]);
            nodes[places[i] + k] = node;
        }
    });
}

/// Triangle rows in the order of the items, and their indices.
template <Executor E>
void copy_triangles(const WorldGeometry& geometry, std::span<const WideItem> items,
                    RawArray<TriangleRows>& rows, RawArray<std::uint32_t>& indices, E& executor) {
    rows.resize(items.size());
    indices.resize(items.size());
    for_each_part(items.size(), wide_part, executor, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t t = items[i].triangle;
            indices[i] = t;
            rows[i] = make_triangle_rows(geometry.corner(t, 0), geometry.corner(t, 1),
                                         geometry.corner(t, 2));
        }
    });
}

}  // namespace detail

template <Executor E>
WideBvh::WideBvh(const WorldGeometry& geometry, const WideBvhOptions& options, E& executor)
    : reach_(reach_of(magnitude_of(geometry.bounds()))) {
    check(options);
    detail::check_coordinates(geometry);
    const std::size_t count = geometry.triangles().size();
    detail::RawArray<detail::WideItem> items;
    detail::RawArray<detail::WideItem> spare(count);
    detail::WideRange all;
    detail::timed(statistics_.prepare_seconds,
                  [&] { all = detail::make_items(geometry, items, executor); });
    const detail::WidePlan plan{
        options,
        std::max({options.max_depth, detail::balanced_depth(count, options.leaf_size), 1u}),
        count == 0 ? 1.0f : detail::area_scale(all.content.box),
        reach_,
        items.data(),
        spare.data()};
    detail::WideGrower<E> top(plan, detail::wide_subtree_size(count), executor);
    detail::timed(statistics_.top_seconds, [&] { top.grow(all, 0); });
    std::vector<detail::WidePart> parts(top.open().size());
    detail::timed(statistics_.subtrees_seconds, [&] {
        executor.for_each(parts.size(), [&](std::size_t i) {
            parts[i] = detail::grow_part(plan, top.open()[i]);
        });
    });
    detail::timed(statistics_.assemble_seconds, [&] {
        nodes_ = std::move(top.nodes());
        detail::assemble(nodes_, top.open(), parts, executor);
        detail::copy_triangles(geometry, items.span(), triangles_, indices_, executor);
    });
    detail::WideTally tally = top.tally();
    for (const detail::WidePart& part : parts) tally.add(part.tally);
    count_parts(tally);
}

inline void WideBvh::count_parts(const detail::WideTally& tally) {
    statistics_.triangles = triangles_.size();
    statistics_.nodes = nodes_.size();
    statistics_.leaves = tally.leaves;
    statistics_.depth = tally.depth;
    statistics_.largest_leaf = tally.largest_leaf;
    statistics_.expected_nodes = tally.node_areas;
    statistics_.expected_tests = tally.triangle_areas;
    statistics_.bytes = bytes();
}

}  // namespace mir
