// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/axis_step.hpp"
#include "mir/accel/exact/reach.hpp"
#include "mir/accel/wide/wide_bvh_view.hpp"

namespace mir {

// Walks a segment through a wide bounding volume hierarchy, near children first, with a stack of
// one entry per level.
//
// Why the bits are those of asking every triangle. Let M be the magnitude of the scene, e = 2^-24
// and X = from + t_x (to - from) the point of accept_box.hpp's lemma, which lies in the accept box
// of the triangle, and so in every box above it, by at least 14 e M in each axis. It suffices that
// a child is visited when, by the numbers computed, t_near <= t_x <= t_far in each axis. With
// d = to - from, a computed t is the fraction at which the segment passes a plane that is displaced
// by at most
//   |t d - (plane - from)| <= 3 e |plane - from| + e |plane| + e |from| <= 12 e M    (unfused)
//                          <= 4 e |plane - from| + e |from|             <= 13.5 e M  (fused),
// since ends and planes lie within 1.5 M except for terms in e^2. So for d > 0
//   t_near d <= low - from + 13.5 e M <= t_x d - 0.5 e M, and the same on the other side.
// A d nearer to zero than 2^-50 reach becomes one of that length: it moves X by less than
// 2^-48 M, which the 0.5 e M cover, and no product overflows. (Where 2^-110 m is longer than that,
// coordinates are so small that no product of two distances differs from zero.) Nothing here is
// infinite or no number, unless an end is none; such a segment crosses nothing.
//
// Why it may stop early. keep_closer() computes t_x with an error of 3 e of itself or of the
// crossing of the plane, whichever is larger. A child that begins behind best.t (1 + 2^-20) holds
// no triangle that comes before the best, or beside it: where the crossing is more than twice t_x,
// the start lies within 32 e M of the plane, and the error moves X by less than e M, of the 9 e M
// that the lemma leaves beyond what slabs need.

namespace detail {

/// A segment as slabs are tested against it.
struct SlabSegment {
    AxisStep steps[3];

    MIR_HD SlabSegment(Vec3 from, Vec3 to, float reach) {
        const float shortest = shortest_step(reach);
        for (int axis = 0; axis < 3; ++axis)
            steps[axis] = axis_step(from[axis], to[axis], shortest);
    }
};

/// Where a segment enters the children of a node, and which of them it meets.
struct MetChildren {
    float begin[WideNode::width];
    std::uint32_t mask = 0;  ///< bit k: child k
};

/// Children whose boxes the segment meets between its start and the fraction `end`. Always those
/// that it meets by 14 e M.
MIR_HD inline MetChildren met_children(const WideNode& node, const SlabSegment& segment,
                                       float end) {
    const AxisStep x = segment.steps[0];
    const AxisStep y = segment.steps[1];
    const AxisStep z = segment.steps[2];
    const int back_x = x.inverse < 0.0f ? 1 : 0;
    const int back_y = y.inverse < 0.0f ? 1 : 0;
    const int back_z = z.inverse < 0.0f ? 1 : 0;
    const ChildRow& near_x = node.planes[back_x];
    const ChildRow& near_y = node.planes[2 + back_y];
    const ChildRow& near_z = node.planes[4 + back_z];
    const ChildRow& far_x = node.planes[1 - back_x];
    const ChildRow& far_y = node.planes[3 - back_y];
    const ChildRow& far_z = node.planes[5 - back_z];
    MetChildren met;
    std::uint32_t bits[WideNode::width];
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        const float x_near = loose::mul_sub(near_x[k], x.inverse, x.offset);
        const float y_near = loose::mul_sub(near_y[k], y.inverse, y.offset);
        const float z_near = loose::mul_sub(near_z[k], z.inverse, z.offset);
        const float x_far = loose::mul_sub(far_x[k], x.inverse, x.offset);
        const float y_far = loose::mul_sub(far_y[k], y.inverse, y.offset);
        const float z_far = loose::mul_sub(far_z[k], z.inverse, z.offset);
        const float first = larger(x_near, larger(y_near, larger(z_near, 0.0f)));
        const float last = smaller(x_far, smaller(y_far, smaller(z_far, end)));
        met.begin[k] = first;
        bits[k] = first <= last ? 1u << k : 0u;
    }
    for (const std::uint32_t bit : bits) met.mask |= bit;
    return met;
}

/// Slots of children in the order of visits, next one in the lowest four bits. A slot stands plus
/// one, so that zero says that there is none left.
struct ChildQueue {
    std::uint32_t slots;

    [[nodiscard]] MIR_HD bool empty() const { return slots == 0; }

    MIR_HD std::uint32_t pop() {
        const std::uint32_t slot = (slots & 15u) - 1u;
        slots >>= 4;
        return slot;
    }

    /// Behind those that begin no later. At most once for each slot.
    MIR_HD void insert(std::uint32_t slot, const float* begin) {
        std::uint32_t before = 0;
        for (std::uint32_t rest = slots; rest != 0; rest >>= 4) {
            if (begin[(rest & 15u) - 1u] > begin[slot]) break;
            before += 4;
        }
        const std::uint32_t nearer = slots & ((1u << before) - 1u);
        slots = nearer | (slot + 1u) << before | (slots ^ nearer) << 4;
    }
};

/// A node some of whose children wait on the stack. Without defaults, which would clear the whole
/// stack for every segment.
struct WaitingNode {
    std::uint32_t node;
    ChildQueue children;
};

/// Shows the met leaves of a node to the visitor. True when it wants no more. The inner children
/// that were met, nearest first, are put into `inner`.
template <class Leaf>
MIR_HD bool visit_children(const WideNode& node, const SlabSegment& segment, Leaf& leaf,
                           ChildQueue& inner) {
    const MetChildren met = met_children(node, segment, leaf.end());
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        if ((met.mask >> k & 1u) == 0) continue;
        if (node.is_inner(k))
            inner.insert(k, met.begin);
        else if (leaf(node.ref[k], node.count[k]))
            return true;
    }
    return false;
}

/// The walk: calls `leaf(first, count)` along the segment until one returns true. The walk then
/// returns that. `leaf.end()` is the fraction of the segment up to which leaves matter. A node is
/// on the stack only while one of its children is visited, so the stack holds nodes of one path
/// alone and never more than the tree is deep.
template <Space S, class Leaf>
MIR_HD bool walk(const WideBvhView<S>& bvh, Vec3 from, Vec3 to, Leaf& leaf) {
    const SlabSegment segment(from, to, bvh.reach);
    WaitingNode stack[WideBvhView<S>::max_depth];
    std::uint32_t waiting = 0;
    std::uint32_t node = WideBvhView<S>::root;
    for (;;) {
        ChildQueue inner{0};
        if (visit_children(bvh.nodes[node], segment, leaf, inner)) return true;
        if (!inner.empty()) stack[waiting++] = {node, inner};
        if (waiting == 0) return false;
        WaitingNode& top = stack[waiting - 1];
        node = bvh.nodes[top.node].ref[top.children.pop()];
        if (top.children.empty()) --waiting;
    }
}

/// Leaf visitor of shadow segments: any triangle will do.
template <Space S, class Mask>
struct FindAnyInLeaf {
    const WideBvhView<S>& bvh;
    const Mask& mask;
    Vec3 from{0};
    Vec3 to{0};

    [[nodiscard]] MIR_HD static float end() { return 1.0f; }

    MIR_HD bool operator()(std::uint32_t first, std::int32_t count) const {
        for (std::int32_t i = 0; i < count; ++i) {
            const std::uint32_t at = first + static_cast<std::uint32_t>(i);
            if (hits_segment(bvh.triangles[at], from, to, bvh.indices[at], mask)) return true;
        }
        return false;
    }
};

/// Leaf visitor of rays.
template <Space S, class Mask>
struct FindFirstInLeaf {
    const WideBvhView<S>& bvh;
    const Mask& mask;
    Vec3 from{0};
    Vec3 to{0};
    TriangleHit best;

    [[nodiscard]] MIR_HD float end() const { return best.t * (1.0f + 0x1p-20f); }

    MIR_HD bool operator()(std::uint32_t first, std::int32_t count) {
        for (std::int32_t i = 0; i < count; ++i) {
            const std::uint32_t at = first + static_cast<std::uint32_t>(i);
            keep_closer(bvh.triangles[at], from, to, bvh.indices[at], best, mask);
        }
        return false;
    }
};

}  // namespace detail

/// True when a triangle of the hierarchy hides the points from each other. Equal in bits to an "or"
/// of hits_segment() over all triangles, and under exchange of the points, which are cut to the
/// hierarchy's reach. `mask` says which triangles stop the segment, an Opaque, an
/// AlphaMaskView or an OpacityView. Thread-safe.
template <Space S, class Mask = Opaque>
[[nodiscard]] MIR_HD bool is_hidden(const WideBvhView<S>& bvh, Vec3 from, Vec3 to,
                                    const Mask& mask = {}) {
    const auto& stops = mask.between(from, to);
    if (!is_left_within_reach(from, to, bvh.reach)) return false;
    detail::FindAnyInLeaf<S, std::remove_cvref_t<decltype(stops)>> any{bvh, stops, from, to};
    return detail::walk(bvh, from, to, any);
}

/// The first triangle along a ray, with t in metres; TriangleHit::none if there is none. Equal in
/// bits to keep_closer() over all triangles.
/// `mask` says which points of triangles are there, an Opaque or an AlphaMaskView. What lies
/// farther than `within` metres may not be found. Thread-safe.
template <Space S, class Mask = Opaque>
[[nodiscard]] MIR_HD TriangleHit first_hit(const WideBvhView<S>& bvh, const Ray& ray,
                                           const Mask& mask = {}, float within = INFINITY) {
    const CutSegment cut = cut_to_reach(ray, bvh.reach);
    if (cut.empty) return {};
    detail::FindFirstInLeaf<S, Mask> first{bvh, mask, cut.from, cut.to, {}};
    first.best.t = share_at(cut, within);
    detail::walk(bvh, cut.from, cut.to, first);
    if (first.best.triangle == TriangleHit::none) return {};
    first.best.t = strict::add(cut.t_from, strict::mul(first.best.t, cut.t_length));
    return first.best;
}

}  // namespace mir
