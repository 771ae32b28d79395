// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/packet_hits.hpp"
#include "mir/accel/wide_traverse.hpp"

namespace mir {

// Sixteen segments from one origin walk a wide hierarchy together: a node is fetched once, and each
// of its children is tested against all lanes at the same time, by the numbers and with the proof
// of wide_traverse.hpp. Loops over lanes have no branches.

namespace detail {

/// Segments of a packet as slabs are tested against them: SlabSegment, lane by lane.
class PacketSlabs {
 public:
    /// Lanes out of `active` decide on which side slabs are entered.
    PacketSlabs(Vec3 origin, const PointPacket& points, std::uint32_t active, float reach) {
        const float shortest = shortest_step(reach);
        const float* const to[3] = {points.x, points.y, points.z};
        for (int axis = 0; axis < 3; ++axis) {
            for (std::uint32_t k = 0; k < lane_count; ++k) {
                const AxisStep step = axis_step(origin[axis], to[axis][k], shortest);
                inverse_[axis].at[k] = step.inverse;
                offset_[axis].at[k] = step.offset;
            }
            const std::uint32_t back =
                active & lanes_where([&](std::uint32_t k) { return inverse_[axis].at[k] < 0.0f; });
            near_[axis] = 2 * axis + (back == active ? 1 : 0);
            far_[axis] = 2 * axis + (back == active ? 0 : 1);
            mixed_ = mixed_ || (back != 0 && back != active);
        }
    }

    /// Lanes whose segments meet the boxes of some children, those that met_children() finds: a
    /// word for each of `slots`, the others stay as they are.
    void meet(const WideNode& node, std::uint32_t slots, std::uint32_t* lanes) const {
        mixed_ ? meet<true>(node, slots, lanes) : meet<false>(node, slots, lanes);
    }

 private:
    template <bool Mixed>
    void meet(const WideNode& node, std::uint32_t slots, std::uint32_t* lanes) const {
        const ChildRow& near_x = node.planes[near_[0]];
        const ChildRow& near_y = node.planes[near_[1]];
        const ChildRow& near_z = node.planes[near_[2]];
        const ChildRow& far_x = node.planes[far_[0]];
        const ChildRow& far_y = node.planes[far_[1]];
        const ChildRow& far_z = node.planes[far_[2]];
        while (slots != 0) {
            const std::uint32_t k = pop_lowest(slots);
            lanes[k] =
                meet<Mixed>({near_x[k], near_y[k], near_z[k]}, {far_x[k], far_y[k], far_z[k]});
        }
    }

    /// For the planes of one box. If `Mixed`, which of them lanes enter by is found lane by lane.
    template <bool Mixed>
    [[nodiscard]] std::uint32_t meet(Vec3 near, Vec3 far) const {
        return lanes_where([&](std::uint32_t lane) {
            const auto at = [&](int axis, float plane) {
                return loose::mul_sub(plane, inverse_[axis].at[lane], offset_[axis].at[lane]);
            };
            const Vec3 a(at(0, near.x), at(1, near.y), at(2, near.z));
            const Vec3 b(at(0, far.x), at(1, far.y), at(2, far.z));
            const auto enter = [](float s, float t) { return Mixed ? smaller(s, t) : s; };
            const auto leave = [](float s, float t) { return Mixed ? larger(s, t) : t; };
            const float first =
                larger(larger(enter(a.x, b.x), enter(a.y, b.y)), larger(enter(a.z, b.z), 0.0f));
            const float last =
                smaller(smaller(leave(a.x, b.x), leave(a.y, b.y)), smaller(leave(a.z, b.z), 1.0f));
            return first <= last;
        });
    }

    LaneFloats inverse_[3];
    LaneFloats offset_[3];
    int near_[3];         ///< plane of a node through which all lanes enter, by axis
    int far_[3];          ///< and through which they leave
    bool mixed_ = false;  ///< on some axis lanes go both ways
};

/// Every child may be met.
struct AllSlots {
    [[nodiscard]] static std::uint32_t met(const WideNode&) { return 0xFFu; }
};

/// Asks the cache for what will be read soon.
inline void prefetch(const void* from, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += 64)
        __builtin_prefetch(static_cast<const char*>(from) + i);
}

/// The packet, and which of its lanes have met a triangle. `Hull` says which children of a node the
/// lanes may meet at all, met(node), and spares asking all lanes about the others.
template <class Hull>
class WidePacketWalk {
 public:
    static constexpr std::uint32_t no_triangle = 0xFFFFFFFFu;

    /// `mask` outlives the walk; nullptr: all triangles are whole.
    WidePacketWalk(const WideBvhView<Space::host>& bvh, const Hull& hull, Vec3 origin,
                   const PointPacket& points, std::uint32_t active,
                   const AlphaMaskView<Space::host>* mask = nullptr)
        : bvh_(bvh),
          hull_(hull),
          mask_(mask),
          origin_(origin),
          points_(points),
          slabs_(origin, points, active, bvh.reach),
          open_(active) {}

    /// Lanes of `active` that meet no triangle below some nodes, which wait as a walk of this kind
    /// leaves them. Nodes wait on a stack with the lanes that meet them, at most seven per level.
    std::uint32_t run(const std::uint32_t* roots, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) stack_[i] = {roots[i], open_};
        waiting_ = count;
        while (waiting_ != 0 && open_ != 0) {
            const Waiting next = stack_[--waiting_];
            if ((next.lanes & open_) != 0) enter(bvh_.nodes[next.node]);
        }
        return open_;
    }

    /// The same below the root.
    std::uint32_t run() {
        const std::uint32_t root = WideBvhView<Space::host>::root;
        return run(&root, 1);
    }

    /// Place of the last triangle that was met, or no_triangle.
    [[nodiscard]] std::uint32_t blocker() const { return blocker_; }

 private:
    struct Waiting {
        std::uint32_t node;
        std::uint32_t lanes;
    };

    /// Asks all lanes about all children before it decides anything, so that no test waits for the
    /// outcome of another.
    void enter(const WideNode& node) {
        std::uint32_t met[WideNode::width];
        const std::uint32_t slots = hull_.met(node);
        slabs_.meet(node, slots, met);
        std::uint32_t leaves = 0;
        for (std::uint32_t rest = slots; rest != 0;) {
            const std::uint32_t k = pop_lowest(rest);
            const std::uint32_t lanes = open_ & met[k];
            if (lanes == 0 || node.count[k] == WideNode::empty) continue;
            if (node.is_inner(k)) {
                prefetch(bvh_.nodes + node.ref[k], sizeof(WideNode));
                stack_[waiting_++] = {node.ref[k], lanes};
            } else {
                prefetch(bvh_.triangles + node.ref[k],
                         static_cast<std::size_t>(node.count[k]) * sizeof(TriangleRows));
                leaves |= 1u << k;
            }
        }
        while (leaves != 0) {
            const std::uint32_t k = pop_lowest(leaves);
            test_leaf(node.ref[k], static_cast<std::uint32_t>(node.count[k]));
        }
    }

    void test_leaf(std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t t = first; t < first + count; ++t) {
            const TriangleRows& rows = bvh_.triangles[t];
            std::uint32_t hit = hit_lanes(rows, origin_rows(rows, origin_), points_, open_);
            if (hit == 0) continue;
            if (mask_ != nullptr)
                hit = solid_lanes(rows, bvh_.indices[t], origin_, points_, hit, *mask_);
            blocker_ = t;
            open_ &= ~hit;
        }
    }

    const WideBvhView<Space::host>& bvh_;
    const Hull& hull_;
    const AlphaMaskView<Space::host>* mask_;
    Vec3 origin_;
    const PointPacket& points_;
    PacketSlabs slabs_;
    std::uint32_t open_;  ///< lanes that still ask
    std::uint32_t blocker_ = no_triangle;
    std::uint32_t waiting_ = 0;
    Waiting stack_[WideBvhView<Space::host>::most_waiting];
};

}  // namespace detail

/// Bit i is set when bit i of `active` is and point i of the packet sees the origin: the bits of
/// !is_hidden(bvh, origin, point i, mask). Thread-safe.
[[nodiscard]] inline std::uint32_t visible_in_packet(const WideBvhView<Space::host>& bvh,
                                                     Vec3 origin, const PointPacket& points,
                                                     std::uint32_t active,
                                                     const AlphaMaskView<Space::host>& mask = {}) {
    std::uint32_t seen = 0;
    std::uint32_t together = 0;
    const bool origin_within = within_reach(origin, bvh.reach);
    for (std::uint32_t k = 0; k < PointPacket::width; ++k) {
        if ((active >> k & 1u) == 0) continue;
        const Vec3 point{points.x[k], points.y[k], points.z[k]};
        if (origin_within && within_reach(point, bvh.reach))
            together |= 1u << k;
        else if (!is_hidden(bvh, origin, point, mask))
            seen |= 1u << k;
    }
    if (together == 0) return seen;
    return seen |
           detail::WidePacketWalk(bvh, detail::AllSlots{}, origin, points, together, &mask).run();
}

}  // namespace mir
