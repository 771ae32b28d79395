// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/wide_splitter.hpp"
#include "mir/accel/wide_node.hpp"

#include <array>
#include <cstdint>

namespace mir::detail {

// No tree is deeper than its plan says. Let h(n) be the number of nodes on a way through a balanced
// tree over n triangles: 0 for what fits into a leaf, else 1 + h(ceil(n / 8)). Claim: a node below
// d others that has n triangles keeps d + h(n) <= max_depth. It does at the root, since the plan's
// max_depth is h of all at least. A node that is cut by areas leaves its largest child at most
// n - 1 triangles, because both sides of every cut have some; so it is cut by areas only if
// d + 1 + h(n - 1) <= max_depth. Otherwise the most numerous group is halved seven times, which
// leaves ceil(n / 8) at most, and d + 1 + h(ceil(n / 8)) = d + h(n). Groups that fit into a leaf
// become one. So d < max_depth for every node, and max_depth <= WideBvhOptions::depth_limit, the
// size of the traversal's stack.

/// h(n) above.
inline std::uint32_t balanced_depth(std::size_t triangles, std::uint32_t leaf_size) {
    std::uint32_t depth = 0;
    for (; triangles > leaf_size; triangles = (triangles + WideNode::width - 1) / WideNode::width)
        ++depth;
    return depth;
}

/// Sums over the nodes of a part of the tree.
struct WideTally {
    std::uint64_t leaves = 0;
    std::uint32_t depth = 0;
    std::uint32_t largest_leaf = 0;
    double node_areas = 0.0;      ///< half surfaces, that of the root being 1
    double triangle_areas = 0.0;  ///< those of leaves, times their triangles

    void add(const WideTally& other) {
        leaves += other.leaves;
        depth = std::max(depth, other.depth);
        largest_leaf = std::max(largest_leaf, other.largest_leaf);
        node_areas += other.node_areas;
        triangle_areas += other.triangle_areas;
    }
};

/// A node to be made, and the slot that is to refer to it.
struct WideJob {
    static constexpr std::uint32_t no_parent = 0xFFFFFFFFu;

    WideRange range;
    std::uint32_t depth = 0;  ///< nodes above
    std::uint32_t parent = no_parent;
    std::uint32_t slot = 0;
};

/// The groups of triangles that become the children of a node.
struct WideGroups {
    std::array<WideRange, WideNode::width> at;
    std::uint32_t count = 0;
};

inline constexpr std::uint32_t no_group = WideNode::width;

/// Grows a tree, or its part above all nodes of at most `enough` triangles.
template <Executor E>
class WideGrower {
 public:
    WideGrower(const WidePlan& plan, std::size_t enough, E& executor)
        : plan_(plan), enough_(enough), splitter_(plan, executor) {}

    void grow(const WideRange& range, std::uint32_t depth) {
        waiting_.push_back({range, depth});
        while (!waiting_.empty()) {
            const WideJob job = waiting_.back();
            waiting_.pop_back();
            make_node(job);
        }
    }

    [[nodiscard]] std::vector<WideNode>& nodes() { return nodes_; }
    [[nodiscard]] const WideTally& tally() const { return tally_; }

    /// Nodes that are still to be made: of at most `enough` triangles.
    [[nodiscard]] const std::vector<WideJob>& open() const { return open_; }

 private:
    void make_node(const WideJob& job) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        if (job.parent != WideJob::no_parent) nodes_[job.parent].ref[job.slot] = index;
        const WideGroups groups = groups_of(job);
        // The last child first, so that children are made in order.
        for (std::uint32_t slot = WideNode::width; slot-- > 0;) {
            if (slot >= groups.count)
                nodes_[index].set_empty(slot, plan_.reach);
            else
                set_child(groups.at[slot], job.depth, index, slot);
        }
        tally_.depth = std::max(tally_.depth, job.depth + 1);
        tally_.node_areas += static_cast<double>(area_of(job.range));
    }

    [[nodiscard]] WideGroups groups_of(const WideJob& job) {
        WideGroups groups;
        const std::size_t n = job.range.count();
        if (n == 0) return groups;
        groups.at[groups.count++] = job.range;
        const std::uint32_t leaf_size = plan_.options.leaf_size;
        const bool by_areas = job.depth + 1 + balanced_depth(n - 1, leaf_size) <= plan_.max_depth;
        while (groups.count < WideNode::width) {
            std::uint32_t next = by_areas ? largest(groups, leaf_size) : fullest(groups, leaf_size);
            const bool to_leaves = next == no_group;
            // Slots that are left hold parts of leaves: their boxes are tested anyway.
            if (to_leaves) next = largest(groups, 1);
            if (next == no_group) break;
            const WideRange range = groups.at[next];
            const WideHalves halves =
                by_areas || to_leaves ? splitter_.cut(range) : splitter_.halve(range);
            groups.at[next] = halves.below;
            groups.at[groups.count++] = halves.above;
        }
        return groups;
    }

    /// The group of the largest surface among those of more than `size` triangles; of equal ones
    /// that of the most triangles, lest coincident triangles become a long chain.
    [[nodiscard]] std::uint32_t largest(const WideGroups& groups, std::size_t size) const {
        return first_of(groups, size, [this](const WideRange& a, const WideRange& b) {
            const float area_a = area_of(a);
            const float area_b = area_of(b);
            return area_a > area_b || (area_a == area_b && a.count() > b.count());
        });
    }

    /// The group of the most triangles, if these are more than `size`.
    [[nodiscard]] static std::uint32_t fullest(const WideGroups& groups, std::size_t size) {
        return first_of(groups, size, [](const WideRange& a, const WideRange& b) {
            return a.count() > b.count();
        });
    }

    template <class Before>
    [[nodiscard]] static std::uint32_t first_of(const WideGroups& groups, std::size_t size,
                                                const Before& before) {
        std::uint32_t best = no_group;
        for (std::uint32_t i = 0; i < groups.count; ++i) {
            if (groups.at[i].count() <= size) continue;
            if (best == no_group || before(groups.at[i], groups.at[best])) best = i;
        }
        return best;
    }

    void set_child(const WideRange& range, std::uint32_t depth, std::uint32_t index,
                   std::uint32_t slot) {
        WideNode& node = nodes_[index];
        const LaneBox& box = range.content.box;
        for (int axis = 0; axis < 3; ++axis)
            node.set_bounds(axis, slot, box.low[axis], box.high[axis]);
        if (range.count() <= plan_.options.leaf_size) {
            node.ref[slot] = static_cast<std::uint32_t>(range.first);
            node.count[slot] = static_cast<std::int32_t>(range.count());
            add_leaf(range);
            return;
        }
        node.ref[slot] = 0;
        node.count[slot] = WideNode::inner;
        (range.count() <= enough_ ? open_ : waiting_).push_back({range, depth + 1, index, slot});
    }

    void add_leaf(const WideRange& range) {
        ++tally_.leaves;
        tally_.largest_leaf =
            std::max(tally_.largest_leaf, static_cast<std::uint32_t>(range.count()));
        tally_.triangle_areas +=
            static_cast<double>(area_of(range)) * static_cast<double>(range.count());
    }

    [[nodiscard]] float area_of(const WideRange& range) const {
        return range.count() == 0 ? 0.0f : half_area(range.content.box, plan_.area_scale);
    }

    const WidePlan& plan_;
    std::size_t enough_;
    WideSplitter<E> splitter_;
    std::vector<WideNode> nodes_;
    std::vector<WideJob> waiting_;
    std::vector<WideJob> open_;
    WideTally tally_;
};

}  // namespace mir::detail
