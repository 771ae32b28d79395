// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/packet_hits.hpp"
#include "mir/accel/wide/detail/packet_hull.hpp"
#include "mir/accel/wide/waiting_nodes.hpp"
#include "mir/accel/wide/wide_traverse.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace mir {

// Segments from one origin, packets of sixteen, walk a wide hierarchy together: a node is fetched
// once, and each of its children is tested against all lanes at the same time, by the proof of
// wide_traverse.hpp. Loops over lanes have no branches.

namespace detail {

/// Segments of a packet as slabs are tested against them: SlabSegment, lane by lane.
template <InstructionSet Set>
class PacketSlabs {
 public:
    /// Lanes out of `active` decide on which side slabs are entered.
    void set(Vec3 origin, const PointPacket& points, std::uint32_t active, float reach) {
        mixed_ = false;
        const float shortest = shortest_step(reach);
        const float* const to[3] = {points.x, points.y, points.z};
        for (int axis = 0; axis < 3; ++axis) {
            // Copies: a look-up by axis, or members that might be the points, would keep the loop
            // from being vectorised.
            const float from = origin[axis];
            LaneFloats ends;
            std::copy(to[axis], to[axis] + lane_count, ends.at);
            LaneFloats inverse;
            for (std::uint32_t k = 0; k < lane_count; ++k)
                inverse.at[k] = inverse_step(strict::sub(ends.at[k], from), shortest);
            for (std::uint32_t k = 0; k < lane_count; ++k)
                offset_[axis].at[k] = strict::mul(from, inverse.at[k]);
            inverse_[axis] = inverse;
            const std::uint32_t back = active & lanes_where<Set>([&](std::uint32_t k) {
                                           return inverse_[axis].at[k] < 0.0f;
                                       });
            near_[axis] = 2 * axis + (back == active ? 1 : 0);
            far_[axis] = 2 * axis + (back == active ? 0 : 1);
            mixed_ = mixed_ || (back != 0 && back != active);
        }
    }

    /// Lanes whose segments meet the box of child `k`. They agree with met_children() except for
    /// rounding. An empty slot may be met by lanes that go both ways.
    [[nodiscard]] std::uint32_t meet(const WideNode& node, std::uint32_t k) const {
        return mixed_ ? meet<true>(node, k) : meet<false>(node, k);
    }

 private:
    /// If `Mixed`, which planes of the box lanes enter by is found lane by lane.
    template <bool Mixed>
    [[nodiscard]] std::uint32_t meet(const WideNode& node, std::uint32_t k) const {
        const auto& planes = node.planes;
        const Vec3 near(planes[near_[0]][k], planes[near_[1]][k], planes[near_[2]][k]);
        const Vec3 far(planes[far_[0]][k], planes[far_[1]][k], planes[far_[2]][k]);
#if defined(__x86_64__)
        if constexpr (Set == InstructionSet::avx512)
            return meet_by_avx512<Mixed>(inverse_, offset_, near, far);
#endif
        return lanes_where<Set>([&](std::uint32_t lane) {
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
    int near_[3];  ///< plane of a node through which all lanes enter, by axis
    int far_[3];   ///< and through which they leave
    bool mixed_;   ///< on some axis lanes go both ways
};

/// A bit for each child of a node.
inline constexpr std::uint32_t all_slots = (1u << WideNode::width) - 1u;

/// The slots of a set, from the lowest; behind them zeros.
using SlotList = std::array<std::uint8_t, WideNode::width>;

/// By set: a bit for each slot that is in it.
inline constexpr auto slot_lists = [] {
    std::array<SlotList, all_slots + 1> lists{};
    for (std::uint32_t slots = 0; slots <= all_slots; ++slots) {
        std::uint32_t count = 0;
        for (std::uint32_t k = 0; k < WideNode::width; ++k)
            if ((slots >> k & 1u) != 0) lists[slots][count++] = static_cast<std::uint8_t>(k);
    }
    return lists;
}();

/// Asks the cache for what will be read soon.
inline void prefetch(const void* from, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += 64)
        __builtin_prefetch(static_cast<const char*>(from) + i);
}

/// Place of a triangle that is none.
inline constexpr std::uint32_t no_triangle = 0xFFFFFFFFu;

/// Packets that walk together, and a bit for each lane that met a triangle. Bits come packet after
/// packet. `Hull` says which children of a node the lanes may meet at all, met<Set>(node), and
/// spares asking all lanes about the others.
template <InstructionSet Set, class Hull, std::uint32_t Packets = 1>
class WidePacketWalk {
 public:
    /// From the origin to `Packets` packets of points, some of them active. `opacity` outlives
    /// the walk; nullptr: all triangles are opaque.
    WidePacketWalk(const WideBvhView<Space::host>& bvh, const Hull& hull, Vec3 origin,
                   const PointPacket* points, std::uint32_t active,
                   const OpacityView<Space::host>* opacity = nullptr)
        : bvh_(bvh),
          hull_(hull),
          opacity_(opacity),
          end_(shared_end(origin, points, active)),
          points_(points),
          open_(active) {
        for (std::uint32_t p = 0; p < Packets; ++p)
            slabs_[p].set(origin, points[p], lanes_of_packet(active, p), bvh.reach);
    }

    /// Lanes of `active` that meet no triangle below the nodes of another walk. That walk left
    /// these nodes to this one.
    std::uint32_t run(const WaitingNodes& roots) {
        for (std::uint32_t g = 0; g < roots.groups() && open_ != 0; ++g) {
            Round round;
            meet_hull(roots.group(g), roots.slots_of(g), round);
            visit(round);
        }
        return finish();
    }

    /// The same below the root.
    std::uint32_t run() {
        Round round;
        meet_hull(bvh_.nodes[WideBvhView<Space::host>::root], all_slots, round);
        visit(round);
        return finish();
    }

    /// Place of the last triangle that was met, or no_triangle.
    [[nodiscard]] std::uint32_t blocker() const { return blocker_; }

 private:
    struct Waiting {
        std::uint32_t node;
        std::uint32_t lanes;
    };

    /// Nodes are visited some at a time, in long loops of known length. A processor guesses wrong
    /// once a loop, not once a node.
    static constexpr std::uint32_t nodes_at_once = 8;
    /// A round takes from the stack only what lies above the remains of earlier rounds. These are
    /// nodes below those that the earlier round put. So the shallowest node that it puts lies
    /// deeper than the shallowest of those, and the stack holds nodes of no more rounds than there
    /// are levels.
    static constexpr std::uint32_t most_waiting =
        (nodes_at_once * WideBvhView<Space::host>::max_depth + 1) * WideNode::width +
        WaitingNodes::capacity;

    /// What a round finds. What lies beyond the counts means nothing.
    struct Round {
        static constexpr std::uint32_t most_children = nodes_at_once * WideNode::width;
        static constexpr std::uint32_t leaf_size = WideBvhOptions::largest_leaf;
        static_assert(most_children <= 256, "children are named by a byte");

        const WideNode* parents[nodes_at_once];
        std::uint32_t parent_count = 0;
        std::uint8_t children[most_children];  ///< that the hull meets: parent, slot
        std::uint32_t child_count = 0;
        std::uint32_t triangles[most_children * leaf_size];  ///< of leaves that lanes meet
        std::uint32_t triangle_count = 0;
    };

    std::uint32_t finish() {
        while (waiting_ != 0 && open_ != 0) {
            Round round;
            for (std::uint32_t i = std::min(nodes_at_once, waiting_); i > 0; --i) {
                const Waiting next = stack_[--waiting_];
                if ((next.lanes & open_) != 0) meet_hull(bvh_.nodes[next.node], all_slots, round);
            }
            visit(round);
        }
        return open_;
    }
    void visit(Round& round) {
        meet_lanes(round);
        ask_triangles(round);
    }

    /// Lists the children of a node, out of `among`, that the hull meets.
    void meet_hull(const WideNode& node, std::uint32_t among, Round& round) const {
        const std::uint32_t slots = hull_.template met<Set>(node) & among;
        const auto first = static_cast<std::uint8_t>(round.parent_count * WideNode::width);
        const SlotList& list = slot_lists[slots];
        std::uint8_t* const to = round.children + round.child_count;
        for (std::uint32_t i = 0; i < WideNode::width; ++i)
            to[i] = static_cast<std::uint8_t>(list[i] + first);
        round.child_count += static_cast<std::uint32_t>(std::popcount(slots));
        round.parents[round.parent_count++] = &node;
    }

    /// Puts children that open lanes meet on the stack, or lists their
    /// triangles.
    void meet_lanes(Round& round) {
        for (std::uint32_t i = 0; i < round.child_count; ++i) {
            const WideNode& node = *round.parents[round.children[i] / WideNode::width];
            const std::uint32_t k = round.children[i] % WideNode::width;
            std::uint32_t lanes = 0;
            for (std::uint32_t p = 0; p < Packets; ++p)
                lanes |= slabs_[p].meet(node, k) << p * lane_count;
            lanes &= open_;
            const std::uint32_t ref = node.ref[k];
            const auto is_inner = static_cast<std::uint32_t>(node.is_inner(k));
            const auto is_met = static_cast<std::uint32_t>(lanes != 0);
            // What nobody meets would keep what is needed waiting. In its place the node itself is
            // asked for, which is at hand: a look-up, because a branch would be guessed wrong.
            const void* const wanted[2] = {&node,
                                           below_[is_inner].from + below_[is_inner].bytes * ref};
            prefetch(wanted[is_met], sizeof(WideNode));
            // Written in any case, and counted where there is something: by sums and products,
            // which compilers do not turn into branches.
            stack_[waiting_] = {ref, lanes};
            waiting_ += is_inner & is_met;
            for (std::uint32_t t = 0; t < Round::leaf_size; ++t)
                round.triangles[round.triangle_count + t] = ref + t;
            // An empty slot counts -1 triangles.
            round.triangle_count +=
                static_cast<std::uint32_t>(std::max(node.count[k], WideNode::inner)) * is_met;
        }
    }

    void ask_triangles(const Round& round) {
        for (std::uint32_t i = 0; i < round.triangle_count; ++i) {
            const std::uint32_t t = round.triangles[i];
            const TriangleRows& rows = bvh_.triangles[t];
            std::uint32_t hit = hit_lanes_of<Set, Packets>(rows, end_, points_, open_);
            if (opacity_ != nullptr && hit != 0) hit = stopped(rows, t, hit);
            blocker_ = hit != 0 ? t : blocker_;
            open_ &= ~hit;
        }
    }

    /// Lanes of `hit` that the triangle stops.
    [[nodiscard]] std::uint32_t stopped(const TriangleRows& rows, std::uint32_t t,
                                        std::uint32_t hit) const {
        std::uint32_t lanes = 0;
        for (std::uint32_t p = 0; p < Packets; ++p)
            lanes |= stopped_lanes(rows, bvh_.indices[t], end_.origin, points_[p],
                                   lanes_of_packet(hit, p), *opacity_)
                     << p * lane_count;
        return lanes;
    }

    /// Where children lie, by their number.
    struct Below {
        const char* from;
        std::size_t bytes;  ///< of one
    };

    const WideBvhView<Space::host>& bvh_;
    const Below below_[2] = {
        {reinterpret_cast<const char*>(bvh_.triangles), sizeof(TriangleRows)},
        {reinterpret_cast<const char*>(bvh_.nodes), sizeof(WideNode)}};  ///< leaves, nodes
    const Hull& hull_;
    const OpacityView<Space::host>* opacity_;
    SharedEnd end_;
    const PointPacket* points_;
    PacketSlabs<Set> slabs_[Packets];
    std::uint32_t open_;  ///< lanes that still ask
    std::uint32_t blocker_ = no_triangle;
    std::uint32_t waiting_ = 0;
    Waiting stack_[most_waiting];
};

}  // namespace detail

/// Bit i: bit i of `active` is set and point i sees the origin. These are the bits of
/// !is_hidden(bvh, origin, point i, opacity). Thread-safe.
template <InstructionSet Set = InstructionSet::baseline>
[[nodiscard]] std::uint32_t visible_in_packet(const WideBvhView<Space::host>& bvh, Vec3 origin,
                                              const PointPacket& points, std::uint32_t active,
                                              const OpacityView<Space::host>& opacity = {}) {
    std::uint32_t seen = 0;
    std::uint32_t together = 0;
    const bool origin_within = within_reach(origin, bvh.reach);
    for (std::uint32_t k = 0; k < PointPacket::width; ++k) {
        if ((active >> k & 1u) == 0) continue;
        const Vec3 point{points.x[k], points.y[k], points.z[k]};
        if (origin_within && within_reach(point, bvh.reach))
            together |= 1u << k;
        else if (!is_hidden(bvh, origin, point, opacity))
            seen |= 1u << k;
    }
    if (together == 0) return seen;
    const detail::PacketHull hull(origin, points, together, bvh.reach);
    detail::WidePacketWalk<Set, detail::PacketHull> walk(bvh, hull, origin, &points, together,
                                                         &opacity);
    return seen | walk.run();
}

}  // namespace mir
