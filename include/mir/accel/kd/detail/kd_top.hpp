// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_level.hpp"
#include "mir/accel/kd/detail/kd_pool.hpp"
#include "mir/concepts/executor.hpp"

namespace mir::detail {

/// A node whose subtree is still to be grown.
struct KdOpenNode {
    KdCell cell;
    RawArray<KdFragment> fragments;
    std::uint32_t node = 0;
    std::uint32_t depth = 0;
};

/// The upper part of a tree: its nodes, and the open ones below.
struct KdTop {
    RawArray<KdNode> nodes;
    std::vector<KdOpenNode> open;
    KdTally tally;
};

/// Cuts large nodes level by level, all threads working on all of them.
template <Executor E>
class KdTopGrower {
 public:
    KdTopGrower(const KdPlan& plan, KdGrowerPool& pool, std::size_t enough, E& executor)
        : plan_(plan), pool_(pool), enough_(enough), executor_(executor) {}

    /// Until no node has more than `enough` fragments. The array of those given is used again.
    KdTop grow(RawArray<KdFragment> all_fragments, const KdCell& cell) {
        results_[1] = std::move(all_fragments);
        const KdRun fragments = results_[1].span();
        top_.nodes.push_back({});
        KdWideNode root;
        root.cell = cell;
        for (std::size_t first = 0; first < fragments.size(); first += KdChunk::enough)
            root.runs.push_back(
                fragments.subspan(first, std::min(KdChunk::enough, fragments.size() - first)));
        root.count = fragments.size();
        root.content = {cell.low, cell.high};
        std::vector<KdWideNode> all;
        all.push_back(std::move(root));
        keep_or_close(std::move(all));
        while (!level_.empty()) cut_level();
        return std::move(top_);
    }

 private:
    template <class Body>
    void for_each_chunk(std::vector<KdChunk>& chunks, const Body& body) {
        executor_.for_each(chunks.size(),
                           [&](std::size_t i) { body(chunks[i], level_[chunks[i].node]); });
    }

    void cut_level() {
        for (KdWideNode& node : level_) node.grid = KdGrid(node.content, node.count);
        std::vector<KdChunk> chunks = chunks_of(level_);
        for_each_chunk(chunks, [](KdChunk& c, const KdWideNode& node) { c.count_bins(node.grid); });
        choose_borders(chunks);
        for_each_chunk(chunks, [](KdChunk& c, const KdWideNode& node) {
            if (node.split.kind == KdCutKind::parts) c.find_events(node.grid, node.border);
        });
        choose_planes(chunks);
        RawArray<KdFragment>& results = results_[turn_];
        turn_ = 1 - turn_;
        results.replace(chunks.back().room + chunks.back().count);
        for_each_chunk(chunks, [&](KdChunk& c, const KdWideNode& node) {
            if (node.split.kind != KdCutKind::parts) return;
            KdGrower& grower = pool_.take();
            c.deal(node, plan_.triangles, results.data(), grower.scratch());
            pool_.give_back(grower);
        });
        keep_or_close(children(chunks, results.data()));
        chunks_ = std::move(chunks);
    }

    /// Cuts off empty space as long as that pays more than the best border.
    void choose_borders(const std::vector<KdChunk>& chunks) {
        std::size_t c = 0;
        for (std::size_t n = 0; n < level_.size(); ++n) {
            KdBins bins = chunks[c].bins[0];
            while (++c < chunks.size() && chunks[c].node == n)
                bins.add(chunks[c].bins[0], level_[n].grid.bins);
            choose_border(level_[n], bins);
        }
    }

    void choose_border(KdWideNode& node, const KdBins& bins) {
        for (;;) {
            const KdCost cost(node.cell, node.count, plan_.options);
            node.split = {};
            if (node.depth >= plan_.max_depth || !cost.usable) return;
            node.border = best_border(bins, node.grid, cost);
            node.split = empty_side(cost, node.content);
            if (node.split.kind == KdCutKind::none || node.split.cost > node.border.cost) {
                node.split.kind = KdCutKind::parts;
                return;
            }
            cut_off(node);
        }
    }

    void cut_off(KdWideNode& node) {
        const bool is_below = node.split.kind == KdCutKind::empty_above;
        const std::uint32_t child = add_children(node);
        node.cell =
            is_below ? cell_below(node.cell, node.split) : cell_above(node.cell, node.split);
        node.node = is_below ? child : child + 1;
        ++node.depth;
        top_.tally.add({1, 1, node.depth, 0, 0.0});
    }

    std::uint32_t add_children(const KdWideNode& node) {
        const auto child = static_cast<std::uint32_t>(top_.nodes.size());
        top_.nodes[node.node] =
            KdNode::inner(static_cast<std::uint32_t>(node.split.axis), node.split.at, child);
        top_.nodes.push_back({});
        top_.nodes.push_back({});
        add_visit(top_.tally, plan_, node.cell, plan_.options.visit_cost());
        return child;
    }

    void choose_planes(const std::vector<KdChunk>& chunks) {
        std::size_t c = 0;
        for (std::size_t n = 0; n < level_.size(); ++n) {
            KdWideNode& node = level_[n];
            events_.replace(0);
            for (; c < chunks.size() && chunks[c].node == n; ++c)
                for (const std::int32_t event : chunks[c].events.span()) events_.push_back(event);
            if (node.split.kind != KdCutKind::parts) continue;
            const KdCost cost(node.cell, node.count, plan_.options);
            node.split = only_inside(search_border(events_, node.border, cost), node.cell);
        }
    }

    /// Children of all nodes that were cut; the others are closed.
    std::vector<KdWideNode> children(const std::vector<KdChunk>& chunks,
                                     const KdFragment* results) {
        std::vector<KdWideNode> next;
        std::size_t c = 0;
        for (std::size_t n = 0; n < level_.size(); ++n) {
            const std::size_t first = c;
            while (c < chunks.size() && chunks[c].node == n) ++c;
            if (level_[n].split.kind == KdCutKind::parts) {
                add_halves(level_[n], {chunks.data() + first, c - first}, results, next);
            } else {
                next.push_back(level_[n]);
                next.back().is_whole = true;
            }
        }
        return next;
    }

    void add_halves(const KdWideNode& node, std::span<const KdChunk> chunks,
                    const KdFragment* results, std::vector<KdWideNode>& next) {
        KdWideNode below;
        KdWideNode above;
        for (const KdChunk& chunk : chunks) {
            const KdFragment* const from = results + chunk.room;
            below.add({from, chunk.sides.below});
            below.add(chunk.parts_below.span());
            below.content.add(chunk.content_below);
            above.add({from + chunk.count - chunk.sides.above, chunk.sides.above});
            above.add(chunk.parts_above.span());
            above.content.add(chunk.content_above);
        }
        below.node = add_children(node);
        above.node = below.node + 1;
        below.depth = above.depth = node.depth + 1;
        below.cell = cell_below(node.cell, node.split);
        above.cell = cell_above(node.cell, node.split);
        next.push_back(std::move(below));
        next.push_back(std::move(above));
    }

    /// What is closed is copied, because it would be overwritten two levels later.
    void keep_or_close(std::vector<KdWideNode> nodes) {
        std::vector<KdWideNode> closed;
        level_.clear();
        for (KdWideNode& node : nodes) {
            const bool is_open = node.count > enough_ && !node.is_whole;
            (is_open ? level_ : closed).push_back(std::move(node));
        }
        const std::size_t first = top_.open.size();
        top_.open.resize(first + closed.size());
        executor_.for_each(closed.size(), [&](std::size_t i) {
            const KdWideNode& node = closed[i];
            KdOpenNode& open = top_.open[first + i];
            open.cell = node.cell;
            open.node = node.node;
            open.depth = node.depth;
            open.fragments.resize(node.count);
            KdFragment* to = open.fragments.data();
            for (const KdRun run : node.runs) to = std::copy(run.begin(), run.end(), to);
        });
    }

    const KdPlan& plan_;
    KdGrowerPool& pool_;
    std::size_t enough_;
    E& executor_;
    KdTop top_;
    std::vector<KdChunk> chunks_;  ///< of the last level: they hold parts of clipped fragments
    std::vector<KdWideNode> level_;
    RawArray<KdFragment> results_[2];
    std::size_t turn_ = 0;
    RawArray<std::int32_t> events_;
};

}  // namespace mir::detail
