// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/detail/plane_crossing.hpp"

// What makes hits_segment() watertight: a segment that passes a triangle's edges by less than
// rounding can hide crosses the triangle, so that neighbours overlap by some units of rounding.
//
// Let e = 2^-24, p and q the ends, m_p and m_q their largest coordinates, X a point in which the
// segment meets the exact triangle, t the share of the way from p to X, m = (1 - t) m_p + t m_q,
// and g the sum of the sizes of a gradient's components.
//
// Claim. Along the segment the computed rows are linear functions between their values at the ends.
// At t they are |s| <= 12.2 e m, u >= -7 e m g_u, v >= -7 e m g_v, 1 - u - v >= -(7 e m G + 2 e)
// with G = g_u + g_v.
// Proof. At an end p a row is computed with the errors e g m_p of stored gradient, products and the
// first two sums, e |w| of the stored offset w and e (g m_p + |w|) of the last sum: 5 e g m_p +
// 2 e |w|, and |w| <= g |X| + row(X) <= g m + row(X), since X lies on the segment. The mean over
// both ends is 7 e g m + 2 e row(X). row(X) is 0 for s, whose g is at most 1.733; it is not
// negative for u and v, and u + v <= 1.
//
// So there is a piece of the segment, thin by the plane, in which all three edges are kept by these
// margins: that is what is asked, with 16, 12, 12 and 12 G + 8 e instead of 12.2, 7, 7 and
// 7 G + 2 e. Not each edge by itself: pieces that keep one each may lie far apart where the
// segment leans. m is taken where the computed s is 0, which is X except for 12.2 e m / |d| of the
// way; it changes by less than a sixteenth if |d| > 200 e |m_p - m_q|. U rounds by 2 e d m g_u, and
// W by twice that and by 4 e d.
//
// The bound: a segment whose ends are both farther from the planes than 100 e times its largest
// coordinate, 6 parts in a million, passes no edge and no vertex that triangles share.
//
// Triangles thinner than 2^-29 of their length squared over their distance from the origin have
// gradients that double precision does not hold to e: they are covered by what surrounds them.

namespace mir::detail {

/// How far outside of an edge a segment may be to be tested again. Its U, V or W is not below
/// -(steep (g_u + g_v) + flat).
struct EdgeDoubt {
    float steep = 0.0f;  ///< metres squared
    float flat = 0.0f;   ///< metres

    [[nodiscard]] MIR_HD float of(const TriangleRows& rows) const {
        const float gradients = strict::add(l1_of_gradient(rows.u), l1_of_gradient(rows.v));
        return strict::add(strict::mul(gradients, steep), flat);
    }
};

/// Doubt of segments up to `size`, metres, from the origin on each axis. Their ends differ by no
/// more than `span` in a coordinate, metres. With 16 e m G |p - q| for the plane, (12 e m G + 8 e)
/// |d| for the edges and |d| <= 1.74 |p - q|, which is less than 37 e m G |p - q| + 14 e |p - q|.
MIR_HD inline EdgeDoubt edge_doubt(float size, float span) {
    const float reach = strict::add(span, strict::mul(0x1p-20f, size));
    return {strict::mul(strict::mul(40.0f * 0x1p-24f, reach), size), strict::mul(0x1p-20f, reach)};
}

MIR_HD inline EdgeDoubt edge_doubt(Vec3 from, Vec3 to) {
    return edge_doubt(larger(max_abs(from), max_abs(to)), max_abs(to - from));
}

/// An edge along the thin piece of a segment that lies in the plane. Its barycentric coordinate is
/// `middle` where the piece crosses the plane and changes by `slope` to the end of the piece.
struct EdgeAlong {
    float middle = 0.0f;
    float slope = 0.0f;

    /// Kept somewhere in the piece.
    [[nodiscard]] MIR_HD bool is_kept() const { return strict::add(middle, fabsf(slope)) >= 0.0f; }
    /// Both kept in one place of the line, if each is kept somewhere.
    [[nodiscard]] MIR_HD static bool meet(EdgeAlong a, EdgeAlong b) {
        if (!(a.slope < 0.0f && b.slope > 0.0f) && !(a.slope > 0.0f && b.slope < 0.0f)) return true;
        return strict::add(strict::mul(a.middle, fabsf(b.slope)),
                           strict::mul(b.middle, fabsf(a.slope))) >= 0.0f;
    }
};

/// The thin piece of a segment by a triangle's plane, and its three edges.
struct ThinPiece {
    EdgeAlong u;
    EdgeAlong v;
    EdgeAlong w;
    float half = 0.0f;  ///< half its length, as a share of the segment

    /// True when some place of the piece keeps all edges. Three intervals have a point in common if
    /// each two of them do (Helly).
    [[nodiscard]] MIR_HD bool keeps_edges() const {
        return u.is_kept() && v.is_kept() && w.is_kept() && EdgeAlong::meet(u, v) &&
               EdgeAlong::meet(u, w) && EdgeAlong::meet(v, w);
    }

    /// Such a place, the nearest to the middle. It runs from -1 at the one end of the piece to 1.
    [[nodiscard]] MIR_HD float place() const {
        float first = -1.0f;
        float last = 1.0f;
        const EdgeAlong edges[3] = {u, v, w};
        for (const EdgeAlong& edge : edges) {
            if (edge.slope == 0.0f) continue;
            const float kept = strict::div(-edge.middle, edge.slope);
            if (edge.slope > 0.0f)
                first = larger(kept, first);
            else
                last = smaller(kept, last);
        }
        return larger(-1.0f, smaller(larger(first, smaller(0.0f, last)), 1.0f));
    }
};

MIR_HD inline ThinPiece thin_piece(const TriangleRows& rows, Vec3 from, Vec3 to,
                                   const RowsAtEnds& at, PlaneCrossing c) {
    constexpr float e = 0x1p-24f;
    const float one = strict::div(1.0f, c.d);
    const float depth_from = fabsf(at.s_from);
    const float depth_to = fabsf(at.s_to);
    const float size = strict::mul(
        strict::add(strict::mul(max_abs(from), depth_to), strict::mul(max_abs(to), depth_from)),
        fabsf(one));
    // Not beyond the ends.
    const float depth = smaller(strict::mul(16.0f * e, size), smaller(depth_from, depth_to));
    const float half = strict::mul(depth, fabsf(one));
    const float margin_u = strict::mul(strict::mul(12.0f * e, size), l1_of_gradient(rows.u));
    const float margin_v = strict::mul(strict::mul(12.0f * e, size), l1_of_gradient(rows.v));
    const float margin_w = strict::add(strict::add(margin_u, margin_v), 8.0f * e);
    const float change_u = strict::sub(at.u_to, at.u_from);
    const float change_v = strict::sub(at.v_to, at.v_from);
    return {{strict::add(strict::mul(c.u, one), margin_u), strict::mul(half, change_u)},
            {strict::add(strict::mul(c.v, one), margin_v), strict::mul(half, change_v)},
            {strict::add(strict::mul(c.w(), one), margin_w),
             strict::mul(half, -strict::add(change_u, change_v))},
            half};
}

/// What hits_segment() says of a segment whose ends lie on opposite sides of the plane.
MIR_HD inline bool is_crossed(const TriangleRows& rows, Vec3 from, Vec3 to, const RowsAtEnds& at,
                              PlaneCrossing c) {
    const EdgeDepths depths = EdgeDepths::of(c);
    // First what most segments fail: by one to three hundredths the faster order on a GPU.
    if (!depths.reach(-edge_doubt(from, to).of(rows))) return false;
    return depths.reach(0.0f) || thin_piece(rows, from, to, at, c).keeps_edges();
}

/// Where a segment meets a triangle that it crosses.
struct MeetingPlace {
    float t = 0.0f;        ///< along the segment, 0 at its start and 1 at its end
    Vec2 barycentrics{0};  ///< of the second and third corner
};

/// Point of the triangle next to one outside of it.
MIR_HD inline Vec2 onto_triangle(float u, float v) {
    u = larger(u, 0.0f);
    v = larger(v, 0.0f);
    const float sum = strict::add(u, v);
    if (!(sum > 1.0f)) return {u, v};
    return {strict::div(u, sum), strict::div(v, sum)};
}

/// Of a segment that is_crossed(). Within the edges it is the crossing of the plane; outside of
/// them a place of the thin piece that keeps them, so that it lies by the triangle.
MIR_HD inline MeetingPlace meeting_place(const TriangleRows& rows, Vec3 from, Vec3 to,
                                         const RowsAtEnds& at, PlaneCrossing c) {
    const MeetingPlace middle{strict::div(at.s_from, strict::sub(at.s_from, at.s_to)),
                              {strict::div(c.u, c.d), strict::div(c.v, c.d)}};
    if (is_inside(c)) return middle;
    const ThinPiece piece = thin_piece(rows, from, to, at, c);
    const float shift = strict::mul(piece.place(), piece.half);
    const auto moved = [shift](float value, float change) {
        return strict::add(value, strict::mul(shift, change));
    };
    return {larger(0.0f, smaller(strict::add(middle.t, shift), 1.0f)),
            onto_triangle(moved(middle.barycentrics.x, strict::sub(at.u_to, at.u_from)),
                          moved(middle.barycentrics.y, strict::sub(at.v_to, at.v_from)))};
}

}  // namespace mir::detail
