// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_bins.hpp"
#include "mir/accel/kd/detail/kd_partition.hpp"
#include "mir/accel/kd/detail/kd_sweep.hpp"
#include "mir/accel/kd/detail/lane_box.hpp"
#include "mir/accel/kd/kd_node.hpp"
#include "mir/accel/kd/kd_statistics.hpp"
#include "mir/core/limits.hpp"

#include <array>

namespace mir::detail {

/// What all parts of one construction share.
struct KdPlan {
    KdTreeOptions options;
    const ClipTriangle* triangles = nullptr;
    std::uint32_t max_depth = 0;
    float area_scale = 1.0f;  ///< 1 / metres: turns half the root's surface into 1
};

/// Sums over the nodes of a part of the tree.
struct KdTally {
    std::uint64_t leaves = 0;
    std::uint64_t empty_leaves = 0;
    std::uint32_t depth = 0;
    std::uint32_t largest_leaf = 0;
    double cost = 0.0;

    void add(const KdTally& other) {
        leaves += other.leaves;
        empty_leaves += other.empty_leaves;
        depth = std::max(depth, other.depth);
        largest_leaf = std::max(largest_leaf, other.largest_leaf);
        cost += other.cost;
    }
};

// Loops that are compiled for several instruction sets take all they call into themselves. What is
// rare stays outside, for the sake of compile times.
[[noreturn, gnu::noinline]] inline void fail_kd_size(std::uint64_t count, const char* what,
                                                     std::uint64_t most) {
    throw Error(ErrorCode::limit_exceeded,
                "the kd-tree needs " + std::to_string(count) + " or more " + what +
                    ", but may have " + std::to_string(most) +
                    " (memory is bounded before it is taken); raise max_references or "
                    "traversal_cost in KdTreeOptions, or simplify the scene");
}

/// @throws Error(limit_exceeded) when a tree has more nodes or references than may be.
inline void check_kd_size(std::uint64_t nodes, std::uint64_t references,
                          const KdTreeOptions& options) {
    if (references > options.max_references)
        fail_kd_size(references, "references to triangles", options.max_references);
    if (nodes > KdNode::max_count) fail_kd_size(nodes, "nodes", KdNode::max_count);
}

/// Half the surface of a cell, with lengths multiplied by `scale` so that nothing overflows.
inline float half_area(const KdCell& cell, float scale) {
    return half_area(LaneBox{cell.low, cell.high}, scale);
}

/// Adds what visiting a node costs a line that meets the root. Its share of the area.
inline void add_visit(KdTally& tally, const KdPlan& plan, const KdCell& cell, float triangles) {
    tally.cost += static_cast<double>(half_area(cell, plan.area_scale) * triangles);
}

/// A subtree's place in the lists of the grower that made it. Its root is the first node; indices
/// count from that node and from its first reference.
struct KdSubtree {
    std::size_t first_node = 0;
    std::size_t nodes = 0;
    std::size_t first_reference = 0;
    std::size_t references = 0;
    KdTally tally;
};

/// Room that one thread uses again and again.
struct KdScratch {
    RawArray<KdFragment> arena;
    RawArray<KdFragment> both;
    KdBinSearch search;
};

/// Grows subtrees one after the other on one thread, all in the same few arrays.
class KdGrower {
 public:
    explicit KdGrower(const KdPlan& plan) : plan_(plan) {}

    KdSubtree grow(std::span<const KdFragment> fragments, const KdCell& cell, std::uint32_t depth) {
        subtree_ = {nodes_.size(), 0, references_.size(), 0, {}};
        scratch_.arena.replace(2 * fragments.size());
        std::copy(fragments.begin(), fragments.end(), scratch_.arena.data());
        nodes_.push_back({});
        jobs_[waiting_++] = {cell, 0, fragments.size(), 0, depth};
        while (waiting_ > 0) step(jobs_[--waiting_]);
        subtree_.nodes = nodes_.size() - subtree_.first_node;
        subtree_.references = references_.size() - subtree_.first_reference;
        return subtree_;
    }

    /// Free between calls of grow().
    [[nodiscard]] KdScratch& scratch() { return scratch_; }

    [[nodiscard]] std::span<const KdNode> nodes(const KdSubtree& s) const {
        return nodes_.span().subspan(s.first_node, s.nodes);
    }
    [[nodiscard]] std::span<const std::uint32_t> references(const KdSubtree& s) const {
        return references_.span().subspan(s.first_reference, s.references);
    }

 private:
    /// A node to be made. Its fragments are the last ones in use in the arena.
    struct Job {
        KdCell cell;
        std::size_t first = 0;
        std::size_t count = 0;
        std::uint32_t node = 0;
        std::uint32_t depth = 0;
    };

    void step(Job job) {
        const std::span<const KdFragment> fragments{scratch_.arena.data() + job.first, job.count};
        KdSplit split;
        if (job.count > kd_sweep_limit) {
            scratch_.search.start(fragments);
            split = cut_off_empty_space(scratch_.search, job);
        } else if (job.count > 0) {
            KdSweep sweep(fragments);
            split = cut_off_empty_space(sweep, job);
        }
        if (split.kind == KdCutKind::none)
            make_leaf(job);
        else
            make_inner(job, split);
    }

    /// Makes nodes with an empty side until the best plane has fragments on both. These stay as
    /// they are in the meantime, and what was sorted stays sorted.
    template <class Search>
    KdSplit cut_off_empty_space(Search& search, Job& job) {
        for (;;) {
            const KdCost cost(job.cell, job.count, plan_.options);
            if (job.depth >= plan_.max_depth || !cost.usable || cost.limit <= 0.0f) return {};
            const KdSplit split = only_inside(search.best(cost), job.cell);
            if (split.kind == KdCutKind::none || split.kind == KdCutKind::parts) return split;
            const std::uint32_t child = add_children(job, split);
            ++subtree_.tally.leaves;
            ++subtree_.tally.empty_leaves;
            const bool is_below = split.kind == KdCutKind::empty_above;
            job.cell = is_below ? cell_below(job.cell, split) : cell_above(job.cell, split);
            job.node = is_below ? child : child + 1;
            ++job.depth;
            subtree_.tally.depth = std::max(subtree_.tally.depth, job.depth);
        }
    }

    void make_leaf(const Job& job) {
        const std::size_t first = references_.size() - subtree_.first_reference;
        check_kd_size(nodes_.size(), references_.size() + job.count, plan_.options);
        references_.resize(references_.size() + job.count);
        std::uint32_t* to = references_.data() + subtree_.first_reference + first;
        for (std::size_t i = 0; i < job.count; ++i) to[i] = scratch_.arena[job.first + i].triangle;
        const auto count = static_cast<std::uint32_t>(job.count);
        nodes_[subtree_.first_node + job.node] =
            KdNode::leaf(static_cast<std::uint32_t>(first), count);
        KdTally& tally = subtree_.tally;
        ++tally.leaves;
        tally.empty_leaves += count == 0 ? 1 : 0;
        tally.depth = std::max(tally.depth, job.depth);
        tally.largest_leaf = std::max(tally.largest_leaf, count);
        add_visit(tally, plan_, job.cell, static_cast<float>(count));
    }

    void make_inner(const Job& job, const KdSplit& split) {
        // The half above stays where it is; the half below is put behind it and grown first.
        const std::size_t top = job.first + job.count;
        scratch_.arena.resize(top + job.count);
        scratch_.both.replace(job.count);
        KdFragment* const above = scratch_.arena.data() + job.first;
        KdFragment* const below = scratch_.arena.data() + top;
        KdSides sides = deal_fragments({above, job.count}, split.axis, split.at, below, above,
                                       scratch_.both.data());
        clip_straddlers({scratch_.both.data(), sides.both}, plan_.triangles, job.cell, split, sides,
                        below, above);
        const std::uint32_t child = add_children(job, split);
        jobs_[waiting_++] = {cell_above(job.cell, split), job.first, sides.above, child + 1,
                             job.depth + 1};
        jobs_[waiting_++] = {cell_below(job.cell, split), top, sides.below, child, job.depth + 1};
    }

    /// Turns a node into an inner one over two empty leaves. Returns the lower one's index.
    std::uint32_t add_children(const Job& job, const KdSplit& split) {
        const auto child = static_cast<std::uint32_t>(nodes_.size() - subtree_.first_node);
        nodes_[subtree_.first_node + job.node] =
            KdNode::inner(static_cast<std::uint32_t>(split.axis), split.at, child);
        nodes_.push_back({});
        nodes_.push_back({});
        add_visit(subtree_.tally, plan_, job.cell, plan_.options.visit_cost());
        return child;
    }

    const KdPlan& plan_;
    KdSubtree subtree_;
    std::array<Job, KdTreeOptions::depth_limit + 2> jobs_;  ///< one for each level above, two below
    std::size_t waiting_ = 0;
    KdScratch scratch_;
    RawArray<KdNode> nodes_;
    RawArray<std::uint32_t> references_;
};

}  // namespace mir::detail
