// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/exact/node_planes.hpp"
#include "mir/shaft/exact/shaft.hpp"

namespace mir {

/// A Shaft as the nodes of a wide hierarchy are tested against it. For each axis which of a child's
/// two planes the segments reach first, and the share of the way at which the first of them passes
/// the one and the last of them the other. One fused operation per plane, no selection per child.
///
/// Why no child is refused that a segment of the shaft needs. Let q be the VPL, p a luxel and X the
/// point of the segment at the share t that lies in the child's box by 14 e M in each axis
/// (wide_traverse.hpp, whose bounds of rounding hold here: the operations are the same). Where the
/// cluster's box [l, h] lies above the VPL, t (l - q) <= X - q <= t (h - q): so t is at least the
/// share at which the step h - q passes the child's lower plane and at most that at which l - q
/// passes the upper one, each with 0.5 e M to spare, which is more than steps that are lengthened
/// to the shortest one move a point. So below. Where the VPL straddles the box both steps
/// give lower bounds, one for children on either side.
struct ShaftSlabs {
    AffineRow front{0, 0, 0, 1};  ///< negative behind the cluster
    detail::AxisStep nears[3];    ///< for planes[2 axis + near_plane[axis]]
    detail::AxisStep fars[3];     ///< for the other one; always 1 where the VPL straddles
    detail::AxisStep others[3];   ///< for the other one as well: a lower bound; 0 elsewhere
    std::uint8_t near_plane[3] = {0, 0, 0};   ///< 1: the upper one
    std::uint8_t front_plane[3] = {0, 0, 0};  ///< that lies farther in front
    bool straddles = false;                   ///< on some axis
};

namespace detail {

MIR_HD inline void set_axis(ShaftSlabs& s, int axis, float apex, float low, float high,
                            float shortest) {
    const bool plus = low >= 0.0f;
    const bool minus = !plus && high < 0.0f;
    s.near_plane[axis] = plus ? 0 : 1;
    s.nears[axis] =
        plus ? face_step(apex, high, 1.0f, shortest) : face_step(apex, -low, -1.0f, shortest);
    if (plus) s.fars[axis] = face_step(apex, low, 1.0f, shortest);
    if (minus) s.fars[axis] = face_step(apex, -high, -1.0f, shortest);
    s.others[axis] = {0.0f, 0.0f};
    if (plus || minus) return;
    s.fars[axis] = {0.0f, -1.0f};
    s.others[axis] = face_step(apex, high, 1.0f, shortest);
    s.straddles = true;
}

}  // namespace detail

/// Slabs of a cluster with luxels and a VPL at `apex`, metres. Both lie within `reach`, that of the
/// hierarchy. `sigma` as for the cluster.
[[nodiscard]] MIR_HD inline ShaftSlabs make_shaft_slabs(const ClusterRecord& cluster, Vec3 apex,
                                                        float sigma, float reach) {
    ShaftSlabs s;
    s.front = detail::front_of(cluster, apex, sigma);
    s.front_plane[0] = s.front.x > 0.0f ? 1 : 0;
    s.front_plane[1] = s.front.y > 0.0f ? 1 : 0;
    s.front_plane[2] = s.front.z > 0.0f ? 1 : 0;
    const float shortest = detail::shortest_step(reach);
    for (int axis = 0; axis < 3; ++axis)
        detail::set_axis(s, axis, apex[axis], strict::sub(cluster.low[axis], apex[axis]),
                         strict::sub(cluster.high[axis], apex[axis]), shortest);
    return s;
}

namespace detail {

/// Shares of the way between which segments may be inside of eight children.
struct ChildIntervals {
    ChildRow begin;
    ChildRow end;
};

/// The largest of three shares and 0.
MIR_HD inline float latest(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
    // Numbers that are not negative are ordered as their bits are, and negative ones below them.
    return __int_as_float(
        __vimax3_s32_relu(__float_as_int(a), __float_as_int(b), __float_as_int(c)));
#else
    return larger(larger(a, b), larger(c, 0.0f));
#endif
}

/// The smallest of three shares, or some negative one of them: nothing begins before 0.
MIR_HD inline float earliest(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
    return __int_as_float(__vimin3_s32(__float_as_int(a), __float_as_int(b), __float_as_int(c)));
#else
    return smaller(smaller(a, b), c);
#endif
}

template <class Node>
MIR_HD ChildIntervals child_intervals(const Node& node, const ShaftSlabs& s) {
    const auto& near_x = plane_row(node, 0, s.near_plane[0] != 0);
    const auto& near_y = plane_row(node, 1, s.near_plane[1] != 0);
    const auto& near_z = plane_row(node, 2, s.near_plane[2] != 0);
    const auto& far_x = plane_row(node, 0, s.near_plane[0] == 0);
    const auto& far_y = plane_row(node, 1, s.near_plane[1] == 0);
    const auto& far_z = plane_row(node, 2, s.near_plane[2] == 0);
    const AxisStep enters[3] = {adapted(node, 0, s.nears[0]), adapted(node, 1, s.nears[1]),
                                adapted(node, 2, s.nears[2])};
    const AxisStep leaves[3] = {adapted(node, 0, s.fars[0]), adapted(node, 1, s.fars[1]),
                                adapted(node, 2, s.fars[2])};
    const auto passes = [](float plane, AxisStep step) {
        return loose::mul_sub(plane, step.inverse, step.offset);
    };
    ChildIntervals t;
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        t.begin[k] = latest(passes(near_x[k], enters[0]), passes(near_y[k], enters[1]),
                            passes(near_z[k], enters[2]));
        t.end[k] = earliest(passes(far_x[k], leaves[0]), passes(far_y[k], leaves[1]),
                            passes(far_z[k], leaves[2]));
    }
    return t;
}

/// The second lower bound where the VPL straddles the cluster's box.
template <class Node>
MIR_HD void meet_other_planes(const Node& node, const ShaftSlabs& s, ChildIntervals& t) {
    for (int axis = 0; axis < 3; ++axis) {
        if (s.others[axis].inverse == 0.0f) continue;
        const auto& lows = plane_row(node, axis, false);
        const AxisStep other = adapted(node, axis, s.others[axis]);
        for (std::uint32_t k = 0; k < WideNode::width; ++k)
            t.begin[k] = larger(t.begin[k], loose::mul_sub(lows[k], other.inverse, other.offset));
    }
}

/// Values of the half-space's row at the foremost corners of eight children, metres.
template <class Node>
MIR_HD ChildRow front_values(const Node& node, const ShaftSlabs& s) {
    const AffineRow front = adapted(node, s.front);
    const auto& x = plane_row(node, 0, s.front_plane[0] != 0);
    const auto& y = plane_row(node, 1, s.front_plane[1] != 0);
    const auto& z = plane_row(node, 2, s.front_plane[2] != 0);
    ChildRow value;
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        const float of_z = loose::mul_add(z[k], front.z, front.w);
        value[k] = loose::mul_add(x[k], front.x, loose::mul_add(y[k], front.y, of_z));
    }
    return value;
}

}  // namespace detail

/// Slots whose boxes hold a point of the shaft within its half-space. Bit k is for slot k of a
/// WideNode or a QuantisedNode; false ones of others may be set, those of empty slots among
/// them.
template <class Node>
[[nodiscard]] MIR_HD std::uint32_t met_slots(const Node& node, const ShaftSlabs& s) {
    detail::ChildIntervals t = detail::child_intervals(node, s);
    if (s.straddles) detail::meet_other_planes(node, s, t);
    const ChildRow front = detail::front_values(node, s);
    std::uint32_t mask = 0;
    for (std::uint32_t k = 0; k < WideNode::width; ++k)
        mask |= t.begin[k] <= t.end[k] && t.begin[k] <= 1.0f && front[k] >= 0.0f ? 1u << k : 0u;
    return mask;
}

}  // namespace mir
