// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_traverse.hpp"

#include <limits>
#include <span>
#include <vector>

namespace mir {

// The alternative to a stack: every leaf knows its cell and, behind each face of it, the smallest
// node that the whole face borders on. A walk goes from leaf to leaf and remembers nothing. Source:
// Popov, Guenther, Seidel, Slusallek, "Stackless kd-tree traversal for high performance GPU ray
// tracing", CGF 26(3), 2007. Same bits as kd_traverse.hpp; slower (docs/performance.md), kept to
// show it.

/// Leaf of a roped tree.
struct KdRopeLeaf {
    static constexpr std::uint32_t outside = 0xFFFFFFFFu;

    float low[3] = {};  ///< faces of the cell, metres; infinite at the border of the tree
    float high[3] = {};
    std::uint32_t below[3] = {outside, outside, outside};  ///< node behind each low face
    std::uint32_t above[3] = {outside, outside, outside};
    std::uint32_t first = 0;  ///< references [first, first + count)
    std::uint32_t count = 0;
};

/// What a walk along ropes reads. Leaf nodes hold the index of a KdRopeLeaf in first().
template <Space S>
struct KdRopesView {
    static constexpr Space space = S;

    const KdNode* nodes = nullptr;
    const KdRopeLeaf* leaves = nullptr;
    const std::uint32_t* references = nullptr;
    const TriangleRows* triangles = nullptr;
    float reach = 0.0f;  ///< as in KdTreeView
};

/// Ropes for a finished kd-tree, in host memory; references and triangles stay the tree's.
class KdRopes {
 public:
    /// `nodes` are those of the tree.
    explicit KdRopes(std::span<const KdNode> nodes);

    /// The tree must be the one whose nodes the ropes were made from, and outlive the view.
    [[nodiscard]] KdRopesView<Space::host> view(const KdTreeView<Space::host>& tree) const {
        return {nodes_.data(), leaves_.data(), tree.references, tree.triangles, tree.reach};
    }
    [[nodiscard]] std::span<const KdNode> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const KdRopeLeaf> leaves() const { return leaves_; }

 private:
    struct Part {
        std::uint32_t node = 0;
        KdRopeLeaf cell;
    };

    [[nodiscard]] std::uint32_t tightened(std::uint32_t rope, const KdRopeLeaf& cell,
                                          std::uint32_t face_axis, bool rope_is_above) const;
    void finish_leaf(const Part& part);

    std::vector<KdNode> nodes_;
    std::vector<KdRopeLeaf> leaves_;
};

/// Follows a rope down to the smallest node that still borders on the whole face.
inline std::uint32_t KdRopes::tightened(std::uint32_t rope, const KdRopeLeaf& cell,
                                        std::uint32_t face_axis, bool rope_is_above) const {
    while (rope != KdRopeLeaf::outside && !nodes_[rope].is_leaf()) {
        const KdNode n = nodes_[rope];
        const std::uint32_t axis = n.axis();
        const bool to_below = axis == face_axis ? rope_is_above : n.split() >= cell.high[axis];
        const bool to_above = axis == face_axis ? !rope_is_above : n.split() <= cell.low[axis];
        if (!to_below && !to_above) break;
        rope = n.below() + (to_below ? 0u : 1u);
    }
    return rope;
}

inline void KdRopes::finish_leaf(const Part& part) {
    KdRopeLeaf leaf = part.cell;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        leaf.below[axis] = tightened(leaf.below[axis], leaf, axis, false);
        leaf.above[axis] = tightened(leaf.above[axis], leaf, axis, true);
    }
    leaf.first = nodes_[part.node].first();
    leaf.count = nodes_[part.node].count();
    nodes_[part.node] = KdNode::leaf(static_cast<std::uint32_t>(leaves_.size()), leaf.count);
    leaves_.push_back(leaf);
}

inline KdRopes::KdRopes(std::span<const KdNode> nodes) : nodes_(nodes.begin(), nodes.end()) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Part root;
    for (float& x : root.cell.low) x = -infinity;
    for (float& x : root.cell.high) x = infinity;
    std::vector<Part> waiting{root};
    while (!waiting.empty()) {
        const Part part = waiting.back();
        waiting.pop_back();
        const KdNode n = nodes_[part.node];
        if (n.is_leaf()) {
            finish_leaf(part);
            continue;
        }
        Part below{n.below(), part.cell};
        Part above{n.below() + 1, part.cell};
        below.cell.high[n.axis()] = n.split();
        below.cell.above[n.axis()] = above.node;
        above.cell.low[n.axis()] = n.split();
        above.cell.below[n.axis()] = below.node;
        waiting.push_back(below);
        waiting.push_back(above);
    }
}

namespace detail {

/// Where a segment leaves a cell, and what lies behind.
struct KdExit {
    float t = 0.0f;
    std::uint32_t node = KdRopeLeaf::outside;
};

MIR_HD inline KdExit exit_on_axis(const KdRopeLeaf& leaf, std::uint32_t axis, float inverse,
                                  float offset) {
    const bool downwards = inverse < 0.0f;
    const float face = downwards ? leaf.low[axis] : leaf.high[axis];
    return {loose::mul_sub(face, inverse, offset), downwards ? leaf.below[axis] : leaf.above[axis]};
}

MIR_HD inline KdExit exit_of(const KdRopeLeaf& leaf, const AxisSteps& steps) {
    const KdExit x = exit_on_axis(leaf, 0, steps.inverse.x, steps.offset.x);
    const KdExit y = exit_on_axis(leaf, 1, steps.inverse.y, steps.offset.y);
    const KdExit z = exit_on_axis(leaf, 2, steps.inverse.z, steps.offset.z);
    const KdExit xy = x.t < y.t ? x : y;
    return xy.t < z.t ? xy : z;
}

/// Node decisions are those of walk(): by the same t of the same planes, so the same triangles are
/// found, and a plane that was crossed is never crossed back.
template <Space S>
MIR_HD bool hides_along_ropes(const KdRopesView<S>& tree, Vec3 from, Vec3 to) {
    const AxisSteps steps = axis_steps(from, to);
    KdExit at{0.0f, 0};
    do {
        KdNode node = tree.nodes[at.node];
        while (!node.is_leaf()) {
            const float inverse = component(steps.inverse, node.axis());
            const float t =
                loose::mul_sub(node.split(), inverse, component(steps.offset, node.axis()));
            node = tree.nodes[node.below() + ((inverse < 0.0f) != (t <= at.t) ? 1u : 0u)];
        }
        const KdRopeLeaf& leaf = tree.leaves[node.first()];
        if (any_hides(tree.triangles, tree.references + leaf.first, leaf.count, from, to))
            return true;
        at = exit_of(leaf, steps);
    } while (at.t < 1.0f && at.node != KdRopeLeaf::outside);
    return false;
}

}  // namespace detail

/// is_hidden() of kd_traverse.hpp, along ropes. Thread-safe.
template <Space S>
[[nodiscard]] MIR_HD bool is_hidden(const KdRopesView<S>& tree, Vec3 from, Vec3 to) {
    if (!within_reach(from, tree.reach) || !within_reach(to, tree.reach)) {
        const CutSegment cut = cut_to_reach(from, to, tree.reach);
        if (cut.empty) return false;
        from = cut.from;
        to = cut.to;
    }
    return detail::hides_along_ropes(tree, from, to);
}

}  // namespace mir
