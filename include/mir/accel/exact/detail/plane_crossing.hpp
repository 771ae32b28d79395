// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/affine_row.hpp"

namespace mir::detail {

/// A triangle's rows at the ends of a segment.
struct RowsAtEnds {
    float u_from = 0.0f;
    float v_from = 0.0f;
    float s_from = 0.0f;
    float u_to = 0.0f;
    float v_to = 0.0f;
    float s_to = 0.0f;
};

/// Where a segment crosses a triangle's plane, all multiplied by d. U and V are the barycentric
/// coordinates u and v times d. They change sign, and nothing else, when the ends change places.
struct PlaneCrossing {
    float d = 0.0f;
    float u = 0.0f;
    float v = 0.0f;

    /// The first corner's barycentric coordinate times d.
    [[nodiscard]] MIR_HD float w() const { return strict::sub(strict::sub(d, u), v); }
};

/// The smaller of two numbers. One instruction on a device; what comes of a NaN may differ.
MIR_HD inline float lesser(float a, float b) {
#if defined(__CUDA_ARCH__)
    return fminf(a, b);
#else
    return smaller(a, b);
#endif
}

/// U, V and W of a crossing, turned to be nonnegative inside of the edges.
struct EdgeDepths {
    float u_or_v = 0.0f;  ///< the smaller one of U and V
    float w = 0.0f;       ///< no number if U or V is none

    [[nodiscard]] MIR_HD static EdgeDepths of(PlaneCrossing c) {
        const float side = c.d > 0.0f ? 1.0f : -1.0f;
        return {lesser(side * c.u, side * c.v), side * c.w()};
    }
    /// All three are not below `least`.
    [[nodiscard]] MIR_HD bool reach(float least) const { return u_or_v >= least && w >= least; }
};

/// Inside the three closed edges, as computed.
MIR_HD inline bool is_inside(PlaneCrossing c) { return EdgeDepths::of(c).reach(0.0f); }

/// The ends lie strictly on opposite sides. By the product, which also refuses segments so short
/// that it vanishes: what follows would have no digits left.
MIR_HD inline bool opposite(float s_from, float s_to) { return strict::mul(s_from, s_to) < 0.0f; }

MIR_HD inline PlaneCrossing crossing(const RowsAtEnds& at) {
    PlaneCrossing c;
    c.d = strict::sub(at.s_to, at.s_from);
    c.u = strict::sub(strict::mul(at.u_from, at.s_to), strict::mul(at.u_to, at.s_from));
    c.v = strict::sub(strict::mul(at.v_from, at.s_to), strict::mul(at.v_to, at.s_from));
    return c;
}

/// `s_from` and `s_to` are those of the row s, which is asked before the others.
MIR_HD inline RowsAtEnds rows_at_ends(const TriangleRows& rows, Vec3 from, Vec3 to, float s_from,
                                      float s_to) {
    return {row_at(rows.u, from), row_at(rows.v, from), s_from,
            row_at(rows.u, to),   row_at(rows.v, to),   s_to};
}

}  // namespace mir::detail
