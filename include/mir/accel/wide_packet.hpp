// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/packet_hits.hpp"
#include "mir/accel/wide_traverse.hpp"

#ifdef MIR_CASCADE_COUNT  // TEMP
namespace mir { inline long cascade_count[32]; }
#define MIR_N(i, n) (MIR_CASCADE_COUNT ? (void)(cascade_count[i] += (n)) : (void)0)
#else
#define MIR_N(i, n) ((void)0)
#endif
namespace mir {

// Sixteen segments from one origin walk a wide hierarchy together: a node is fetched once, its
// children are tested against all lanes at the same time. Loops over lanes have no branches.

namespace detail {

/// Segments of a packet as slabs are tested against them: SlabSegment, lane by lane.
struct PacketSlabs {
    LaneFloats inverse[3];
    LaneFloats offset[3];

    PacketSlabs(Vec3 origin, const PointPacket& points, float reach) {
        const float shortest = shortest_step(reach);
        const float* const to[3] = {points.x, points.y, points.z};
        for (int axis = 0; axis < 3; ++axis)
            for (std::uint32_t k = 0; k < lane_count; ++k) {
                const AxisStep step = axis_step(origin[axis], to[axis][k], shortest);
                inverse[axis].at[k] = step.inverse;
                offset[axis].at[k] = step.offset;
            }
    }

    /// Lanes whose segments meet the box of a child: those that met_children() finds.
    [[nodiscard]] std::uint32_t met(const WideNode& node, std::uint32_t slot) const {
        const float low[3] = {node.low(0, slot), node.low(1, slot), node.low(2, slot)};
        const float high[3] = {node.high(0, slot), node.high(1, slot), node.high(2, slot)};
        return lanes_where([&](std::uint32_t k) {
            float first = 0.0f;
            float last = 1.0f;
            for (int axis = 0; axis < 3; ++axis) {
                const float a = loose::mul_sub(low[axis], inverse[axis].at[k], offset[axis].at[k]);
                const float b = loose::mul_sub(high[axis], inverse[axis].at[k], offset[axis].at[k]);
                first = larger(first, smaller(a, b));
                last = smaller(last, larger(a, b));
            }
            return first <= last;
        });
    }
};

/// Every child may be met.
struct AllSlots {
    [[nodiscard]] static std::uint32_t met(const WideNode&) { return 0xFFu; }
};

/// The packet, and which of its lanes have met a triangle. `Hull` says which children of a node the
/// lanes may meet at all, met(node), and spares asking all lanes about the others.
template <class Hull>
class WidePacketWalk {
 public:
    WidePacketWalk(const WideBvhView<Space::host>& bvh, const Hull& hull, Vec3 origin,
                   const PointPacket& points, std::uint32_t active)
        : bvh_(bvh),
          hull_(hull),
          origin_(origin),
          points_(points),
          slabs_(origin, points, bvh.reach),
          open_(active) {}

    /// Lanes of `active` that meet no triangle below some nodes.
    std::uint32_t run(const std::uint32_t* roots, std::uint32_t count) {
        Waiting stack[(WideNode::width - 1) * WideBvhView<Space::host>::max_depth + 1];
        for (std::uint32_t i = 0; i < count; ++i) stack[i] = {roots[i], open_};
        for (std::uint32_t waiting = count; waiting != 0 && open_ != 0;) {
            const Waiting next = stack[--waiting];
            if ((next.lanes & open_) != 0) enter(bvh_.nodes[next.node], stack, waiting);
        }
        return open_;
    }
    std::uint32_t run() {
        const std::uint32_t root = WideBvhView<Space::host>::root;
        return run(&root, 1);
    }

 private:
    struct Waiting {
        std::uint32_t node;
        std::uint32_t lanes;
    };

    void enter(const WideNode& node, Waiting* stack, std::uint32_t& waiting) {
        MIR_N(20, 1);
        std::uint32_t leaves = 0;
        for (std::uint32_t rest = hull_.met(node); rest != 0;) {
            const std::uint32_t k = pop_lowest(rest);
            if (node.count[k] == WideNode::empty) continue;
            MIR_N(21, 1);
            const std::uint32_t lanes = open_ & slabs_.met(node, k);
            if (lanes == 0) continue;
            if (node.is_inner(k)) {
                fetch(bvh_.nodes + node.ref[k], sizeof(WideNode));
                stack[waiting++] = {node.ref[k], lanes};
            } else {
                fetch(bvh_.triangles + node.ref[k],
                      static_cast<std::size_t>(node.count[k]) * sizeof(TriangleRows));
                leaves |= 1u << k;
            }
        }
        while (leaves != 0) {
            const std::uint32_t k = pop_lowest(leaves);
            test_leaf(node.ref[k], static_cast<std::uint32_t>(node.count[k]));
        }
    }

    static void fetch(const void* from, std::size_t bytes) {
        for (std::size_t i = 0; i < bytes; i += 64)
            __builtin_prefetch(static_cast<const char*>(from) + i);
    }

    void test_leaf(std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t t = first; t < first + count; ++t) {
            const TriangleRows& rows = bvh_.triangles[t];
            MIR_N(22, 1);
            const std::uint32_t hit = hit_lanes(rows, origin_rows(rows, origin_), points_, open_);
            if (hit != 0) blocker = t;
            open_ &= ~hit;
        }
    }
 public:
    std::uint32_t blocker = ~0u;
 private:

    const WideBvhView<Space::host>& bvh_;
    const Hull& hull_;
    Vec3 origin_;
    const PointPacket& points_;
    PacketSlabs slabs_;
    std::uint32_t open_;  ///< lanes that still ask
};

}  // namespace detail

/// Bit i is set when bit i of `active` is and point i of the packet sees the origin: the bits of
/// !is_hidden(bvh, origin, point i). Thread-safe.
[[nodiscard]] inline std::uint32_t visible_in_packet(const WideBvhView<Space::host>& bvh,
                                                     Vec3 origin, const PointPacket& points,
                                                     std::uint32_t active) {
    std::uint32_t seen = 0;
    std::uint32_t together = 0;
    const bool origin_within = within_reach(origin, bvh.reach);
    for (std::uint32_t k = 0; k < PointPacket::width; ++k) {
        if ((active >> k & 1u) == 0) continue;
        const Vec3 point{points.x[k], points.y[k], points.z[k]};
        if (origin_within && within_reach(point, bvh.reach))
            together |= 1u << k;
        else if (!is_hidden(bvh, origin, point))
            seen |= 1u << k;
    }
    if (together == 0) return seen;
    return seen |
           detail::WidePacketWalk(bvh, detail::AllSlots{}, origin, points, together).run();
}

}  // namespace mir
