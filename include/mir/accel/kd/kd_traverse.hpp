// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/axis_step.hpp"
#include "mir/accel/exact/reach.hpp"
#include "mir/accel/kd/kd_tree_view.hpp"

namespace mir {

// Walks a segment through a kd-tree, front to back, with a stack of one entry per level (Hapala and
// Havran, "Review: kd-tree traversal algorithms for ray tracing", CGF 30(1), 2011, TA-B).
//
// Why the bits are those of asking every triangle. Let X = from + t_x (to - from) be the point of
// accept_box.hpp's lemma. At each plane the walk compares t_x, by way of the interval it carries,
// with a computed t: it goes to the first side only if t_x <= t and to the second only if t_x >= t,
// so X is never dropped. What rounding costs is that the side may be the wrong one for an X close
// to the plane. With d = to - from, e = 2^-24 and M as there, t is the fraction at which the
// segment passes a plane that is displaced by at most
//   |t d - (split - origin)| <= 3 e |split - origin| + e |split| + e |origin| <= 12 e M  (host)
//                            <= 4 e |split - origin| + e |origin|             <= 14 e M  (device),
// because X, and so the plane, lies within 1.5 M; that is what accept_margin_of() leaves over. It
// needs no case for segments along an axis, in a plane or from a plane: a component of zero becomes
// shortest_step(), far below those errors, whose t compare like infinities. Intervals are closed, a
// tie may go either way.

namespace detail {

/// A cell that waits on the stack. Its part of the segment begins where the last one visited ended.
/// Without defaults, which would clear the whole stack for every segment.
struct WaitingCell {
    std::uint32_t node;
    float end;
};

/// What a walk looks up by axis and by level.
template <Space S>
struct KdWalkMemory {
    AxisStep steps[3];
    WaitingCell stack[KdTreeView<S>::max_depth];
};

/// Where a walk stands: a node, and the part of the segment inside its cell.
struct KdWalkState {
    KdNode node;
    float begin = 0.0f;
    float end = 1.0f;
    std::uint32_t waiting = 0;  ///< cells on the stack
};

/// At the root. Both ends lie within the tree's reach.
template <Space S>
MIR_HD KdWalkState start_walk(const KdTreeView<S>& tree, Vec3 from, Vec3 to,
                              KdWalkMemory<S>& memory) {
    const float shortest = shortest_step(tree.reach);
    memory.steps[0] = axis_step(from.x, to.x, shortest);
    memory.steps[1] = axis_step(from.y, to.y, shortest);
    memory.steps[2] = axis_step(from.z, to.z, shortest);
    return {tree.nodes[KdTreeView<S>::root]};
}

/// Goes down to a leaf, the next one along the segment.
template <Space S>
MIR_HD void descend(const KdTreeView<S>& tree, KdWalkMemory<S>& memory, KdWalkState& at) {
    while (!at.node.is_leaf()) {
        const KdChildren children = tree.children(at.node);
        const AxisStep step = memory.steps[at.node.axis()];
        const float t = loose::mul_sub(at.node.split(), step.inverse, step.offset);
        const bool downwards = step.inverse < 0.0f;
        const bool behind = t <= at.begin;
        if (!behind && t < at.end) {
            memory.stack[at.waiting++] = {at.node.below() + (downwards ? 0u : 1u), at.end};
            at.end = t;
        }
        at.node = downwards != behind ? children.above : children.below;
    }
}

/// Takes the cell behind the leaf's from the stack; false when none waits.
template <Space S>
MIR_HD bool next_cell(const KdTreeView<S>& tree, const KdWalkMemory<S>& memory, KdWalkState& at) {
    if (at.waiting == 0) return false;
    at.begin = at.end;
    at.end = memory.stack[--at.waiting].end;
    at.node = tree.nodes[memory.stack[at.waiting].node];
    return true;
}

/// The walk: calls `leaf(node, end)` along the segment until one returns true. The walk then
/// returns that. `end` is the fraction of the segment at which the leaf's cell ends.
template <Space S, class Leaf>
MIR_HD bool walk(const KdTreeView<S>& tree, Vec3 from, Vec3 to, Leaf& leaf) {
    KdWalkMemory<S> memory;
    KdWalkState at = start_walk(tree, from, to, memory);
    do {
        descend(tree, memory, at);
        if (leaf(at.node, at.end)) return true;
    } while (next_cell(tree, memory, at));
    return false;
}

/// True when one of the leaf's triangles hides the segment's ends from each other. This is
/// hits_segment(), with its two conditions apart: one boolean less per triangle on the device,
/// which is a sixth of the instructions of a triangle whose plane is not crossed.
template <Space S, class Mask = Opaque>
MIR_HD bool any_hides(const KdTreeView<S>& tree, KdNode leaf, Vec3 from, Vec3 to,
                      const Mask& mask = {}) {
    const std::uint32_t last = leaf.first() + leaf.count();
    for (std::uint32_t i = leaf.first(); i != last; ++i) {
        const std::uint32_t triangle = tree.references[i];
        const TriangleRows& rows = tree.triangles[triangle];
        const float s_from = row_at(rows.s, from);
        const float s_to = row_at(rows.s, to);
        if (!opposite(s_from, s_to)) continue;
        const RowsAtEnds at = rows_at_ends(rows, from, to, s_from, s_to);
        const PlaneCrossing c = crossing(at);
        if (is_crossed(rows, from, to, at, c) && is_solid(rows, from, to, at, c, triangle, mask))
            return true;
    }
    return false;
}

/// Leaf visitor of shadow segments: any triangle will do, in whichever cell the crossing lies.
template <Space S, class Mask>
struct FindAny {
    const KdTreeView<S>& tree;
    const Mask& mask;
    Vec3 from{0};
    Vec3 to{0};

    MIR_HD bool operator()(KdNode leaf, float) const {
        return any_hides(tree, leaf, from, to, mask);
    }
};

/// Leaf visitor of rays. The walk may stop where the best crossing, enlarged by the rounding of its
/// t, ends: no triangle of a later cell can come before it, or beside it.
template <Space S, class Mask>
struct FindFirst {
    const KdTreeView<S>& tree;
    const Mask& mask;
    Vec3 from{0};
    Vec3 to{0};
    TriangleHit best;

    MIR_HD bool operator()(KdNode leaf, float end) {
        const std::uint32_t last = leaf.first() + leaf.count();
        for (std::uint32_t i = leaf.first(); i != last; ++i) {
            const std::uint32_t triangle = tree.references[i];
            keep_closer(tree.triangles[triangle], from, to, triangle, best, mask);
        }
        return best.t * (1.0f + 0x1p-20f) < end;
    }
};

}  // namespace detail

/// True when a triangle of the tree hides the points from each other. Equal in bits to an "or" of
/// hits_segment() over all triangles, and under exchange of the points, which are cut to the tree's
/// reach. `mask` says which triangles stop the segment, an Opaque, an AlphaMaskView or an
/// OpacityView. Cheapest when `from` is the end next to which most occluders are; thread-safe.
template <Space S, class Mask = Opaque>
[[nodiscard]] MIR_HD bool is_hidden(const KdTreeView<S>& tree, Vec3 from, Vec3 to,
                                    const Mask& mask = {}) {
    const auto& stops = mask.between(from, to);
    if (!is_left_within_reach(from, to, tree.reach)) return false;
    detail::FindAny<S, std::remove_cvref_t<decltype(stops)>> any{tree, stops, from, to};
    return detail::walk(tree, from, to, any);
}

/// The first triangle along a ray, with t in metres; TriangleHit::none if there is none. Equal in
/// bits to keep_closer() over all triangles.
/// `mask` says which points of triangles are there, an Opaque or an AlphaMaskView. What lies
/// farther than `within` metres may not be found. Thread-safe.
template <Space S, class Mask = Opaque>
[[nodiscard]] MIR_HD TriangleHit first_hit(const KdTreeView<S>& tree, const Ray& ray,
                                           const Mask& mask = {}, float within = INFINITY) {
    const CutSegment cut = cut_to_reach(ray, tree.reach);
    if (cut.empty) return {};
    detail::FindFirst<S, Mask> first{tree, mask, cut.from, cut.to, {}};
    first.best.t = share_at(cut, within);
    detail::walk(tree, cut.from, cut.to, first);
    if (first.best.triangle == TriangleHit::none) return {};
    first.best.t = strict::add(cut.t_from, strict::mul(first.best.t, cut.t_length));
    return first.best;
}

}  // namespace mir
