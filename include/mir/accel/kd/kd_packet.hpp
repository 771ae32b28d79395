// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/packet_hits.hpp"
#include "mir/accel/kd/kd_traverse.hpp"

namespace mir {

// Sixteen segments from one origin walk a kd-tree together. The origin decides for all of them
// which side of a plane comes first, so a node is fetched and its children are ordered once. Loops
// over lanes have no branches: they become vector instructions of the caller's instruction
// set.

namespace detail {

/// Part of each lane's segment inside a cell; empty where begin > end.
struct LaneIntervals {
    LaneFloats begin;
    LaneFloats end;
};

struct WaitingLanes {
    std::uint32_t node;
    LaneIntervals part;
};

/// The packet, its lanes' directions, and which of them have met a triangle.
template <InstructionSet Set>
class PacketWalk {
 public:
    PacketWalk(const KdTreeView<Space::host>& tree, Vec3 origin, const PointPacket& points,
               std::uint32_t active, const OpacityView<Space::host>& opacity)
        : tree_(tree),
          opacity_(opacity),
          origin_(origin),
          end_(shared_end(origin, &points, active)),
          points_(points),
          open_(active) {
        const float shortest = shortest_step(tree.reach);
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            inverse_[0].at[k] = inverse_step(points.x[k] - origin.x, shortest);
            inverse_[1].at[k] = inverse_step(points.y[k] - origin.y, shortest);
            inverse_[2].at[k] = inverse_step(points.z[k] - origin.z, shortest);
        }
    }

    /// Lanes of `active` that meet no triangle.
    std::uint32_t run();

 private:
    std::uint32_t enter_children(KdNode node, LaneIntervals& part);
    void test_leaf(KdNode leaf);

    const KdTreeView<Space::host>& tree_;
    const OpacityView<Space::host>& opacity_;
    Vec3 origin_;
    SharedEnd end_;
    const PointPacket& points_;
    std::uint32_t open_;  ///< lanes that still ask
    LaneFloats inverse_[3];
    std::uint32_t waiting_ = 0;
    WaitingLanes stack_[KdTreeView<Space::host>::max_depth];
};

/// Splits the lanes' intervals at the node's plane. Returns the child to go on with; another
/// one that lanes need is put on the stack.
template <InstructionSet Set>
std::uint32_t PacketWalk<Set>::enter_children(KdNode node, LaneIntervals& part) {
    const float* inverse = inverse_[node.axis()].at;
    const float gap = node.split() - origin_[static_cast<int>(node.axis())];
    const bool starts_below = gap >= 0.0f;
    LaneIntervals far;
    for (std::uint32_t k = 0; k < lane_count; ++k) {
        // Lanes that move away from the plane never cross it.
        const bool towards = (inverse[k] > 0.0f) == starts_below;
        const float t = towards ? gap * inverse[k] : 2.0f;
        far.begin.at[k] = larger(part.begin.at[k], t);
        far.end.at[k] = part.end.at[k];
        part.end.at[k] = smaller(part.end.at[k], t);
    }
    const std::uint32_t in_near = open_ & lanes_where<Set>([&](std::uint32_t k) {
                                      return part.begin.at[k] <= part.end.at[k];
                                  });
    const std::uint32_t in_far =
        open_ & lanes_where<Set>([&](std::uint32_t k) { return far.begin.at[k] <= far.end.at[k]; });
    const std::uint32_t near_child = node.below() + (starts_below ? 0u : 1u);
    const std::uint32_t far_child = node.below() + (starts_below ? 1u : 0u);
    if (in_near == 0) {
        part = far;
        return far_child;
    }
    if (in_far != 0) stack_[waiting_++] = {far_child, far};
    return near_child;
}

template <InstructionSet Set>
void PacketWalk<Set>::test_leaf(KdNode leaf) {
    const std::uint32_t* reference = tree_.references + leaf.first();
    for (const std::uint32_t* end = reference + leaf.count(); reference != end; ++reference) {
        const TriangleRows& rows = tree_.triangles[*reference];
        const std::uint32_t hit =
            hit_lanes<Set>(rows, origin_rows(rows, origin_), end_, points_, open_);
        if (hit != 0) open_ &= ~stopped_lanes(rows, *reference, origin_, points_, hit, opacity_);
    }
}

template <InstructionSet Set>
std::uint32_t PacketWalk<Set>::run() {
    LaneIntervals part;
    for (std::uint32_t k = 0; k < lane_count; ++k) {
        part.begin.at[k] = 0.0f;
        part.end.at[k] = 1.0f;
    }
    KdNode node = tree_.nodes[KdTreeView<Space::host>::root];
    for (;;) {
        while (!node.is_leaf()) node = tree_.nodes[enter_children(node, part)];
        test_leaf(node);
        do {
            if (waiting_ == 0 || open_ == 0) return open_;
            --waiting_;
            part = stack_[waiting_].part;
        } while ((open_ & lanes_where<Set>([&](std::uint32_t k) {
                      return part.begin.at[k] <= part.end.at[k];
                  })) == 0);
        node = tree_.nodes[stack_[waiting_].node];
    }
}

}  // namespace detail

/// Bit i: bit i of `active` is set and point i sees the origin. These are the bits of
/// !is_hidden(tree, origin, point i, mask). Thread-safe.
template <InstructionSet Set = InstructionSet::baseline>
[[nodiscard]] std::uint32_t visible_in_packet(const KdTreeView<Space::host>& tree, Vec3 origin,
                                              const PointPacket& points, std::uint32_t active,
                                              const OpacityView<Space::host>& opacity = {}) {
    std::uint32_t seen = 0;
    std::uint32_t together = 0;
    const bool origin_within = within_reach(origin, tree.reach);
    for (std::uint32_t k = 0; k < PointPacket::width; ++k) {
        if ((active >> k & 1u) == 0) continue;
        const Vec3 point{points.x[k], points.y[k], points.z[k]};
        if (origin_within && within_reach(point, tree.reach))
            together |= 1u << k;
        else if (!is_hidden(tree, origin, point, opacity))
            seen |= 1u << k;
    }
    if (together == 0) return seen;
    return seen | detail::PacketWalk<Set>(tree, origin, points, together, opacity).run();
}

}  // namespace mir
