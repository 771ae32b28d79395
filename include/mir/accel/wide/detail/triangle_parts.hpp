// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/accept_box.hpp"

#include <cstdint>

namespace mir::detail {

// Why boxes of parts hold what the accept box holds. By the lemma of accept_box.hpp a segment that
// is accepted has a point X within 41 e M, per axis, of a point Y of the accept triangle: the foot
// of X. Planes cut the accept triangle into parts that together are all of it, and the box of each
// is found in double precision, whose rounding moves it by less than 2^-48 M. So Y lies in one of
// these boxes up to that, and X in the same box grown by the accept margin, 64 e M, by 14 e M and
// more: what traversal needs of one of the boxes that lead to the triangle. Accept triangles that
// leave the reach are not cut, because that bound on rounding does not hold for them.

/// Box around a part of an accept triangle, metres.
struct PartBox {
    Double3 low;
    Double3 high;

    MIR_HD PartBox(Double3 l, Double3 h) : low(l), high(h) {}

    /// Of no point. Number by number: nvcc 13.0 complains about vectors that are constants.
    MIR_HD PartBox() {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = INFINITY;
            high[axis] = -INFINITY;
        }
    }

    MIR_HD void add(Double3 p) {
        low = smaller_axes(low, p);
        high = larger_axes(high, p);
    }

    /// Cut to `within`. What rounding makes empty keeps a point.
    MIR_HD void cut_to(const PartBox& within) {
        high = smaller_axes(high, within.high);
        low = smaller_axes(larger_axes(low, within.low), high);
    }
};

/// Metres.
MIR_HD inline double longest_side(const PartBox& box) {
    const Double3 e = strict::sub(box.high, box.low);
    const double longer = e.x < e.y ? e.y : e.x;
    return longer < e.z ? e.z : longer;
}

/// Whether it lies in the cube of that half edge around the origin; numbers are.
MIR_HD inline bool is_within(const PartBox& box, double reach) {
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
        within = within && box.low[axis] >= -reach && box.high[axis] <= reach;
    return within;
}

/// Around all of it.
MIR_HD inline PartBox box_of(const AcceptTriangle& t) {
    PartBox box;
    box.add(t.a);
    box.add(t.b);
    box.add(t.c);
    return box;
}

/// Half the surface, m^2 times `scale` squared.
MIR_HD inline double half_area(const PartBox& box, double scale) {
    const Double3 e = strict::mul(scale, strict::sub(box.high, box.low));
    return strict::add(strict::add(strict::mul(e.x, e.y), strict::mul(e.y, e.z)),
                       strict::mul(e.z, e.x));
}

/// The same of ever smaller boxes around a triangle: its shadows on the three planes.
MIR_HD inline double least_half_area(const AcceptTriangle& t, double scale) {
    const Double3 e1 = strict::mul(scale, strict::sub(t.b, t.a));
    const Double3 e2 = strict::mul(scale, strict::sub(t.c, t.a));
    return strict::mul(0.5, l1_norm(strict::cross(e1, e2)));
}

/// What a plane makes of a part.
struct PartPair {
    PartBox below;
    PartBox above;
};

/// Adds the end `p` of the edge from p to q to its sides. Both get the point where the edge passes
/// the plane.
MIR_HD inline void add_edge(PartPair& pair, Double3 p, Double3 q, int axis, double at) {
    if (p[axis] <= at) pair.below.add(p);
    if (p[axis] >= at) pair.above.add(p);
    if ((p[axis] < at) == (q[axis] < at)) return;
    const double t = strict::div(strict::sub(at, p[axis]), strict::sub(q[axis], p[axis]));
    Double3 x = strict::add(p, strict::mul(t, strict::sub(q, p)));
    x[axis] = at;
    pair.below.add(x);
    pair.above.add(x);
}

/// Cuts a part of the accept triangle `t` by a plane. The plane at `at` lies inside the part's box.
/// Source: Stich, Friedrich and Dietrich, "Spatial splits in bounding volume hierarchies", High
/// Performance Graphics 2009.
MIR_HD inline PartPair cut_part(const AcceptTriangle& t, const PartBox& part, int axis, double at) {
    PartPair pair;
    add_edge(pair, t.a, t.b, axis, at);
    add_edge(pair, t.b, t.c, axis, at);
    add_edge(pair, t.c, t.a, axis, at);
    pair.below.cut_to(part);
    pair.above.cut_to(part);
    return pair;
}

/// As a leaf of the tree needs it: grown by `sigma`, metres, and rounded outwards.
MIR_HD inline Bounds grown(const PartBox& part, double sigma) {
    return rounded_outwards(strict::sub(part.low, Double3(sigma)),
                            strict::add(part.high, Double3(sigma)));
}

}  // namespace mir::detail
