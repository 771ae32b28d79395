// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/affine_row.hpp"
#include "mir/accel/exact/detail/thick_triangle.hpp"
#include "mir/accel/exact/triangle_mask.hpp"
#include "mir/core/double3.hpp"
#include "mir/data/triangle_hit.hpp"

namespace mir {

namespace detail {

/// A triangle as affine frame, double precision. A point is corner + u e1 + v e2 + s normal.
struct TriangleFrame {
    Double3 corner{0};
    Double3 e1{0};
    Double3 e2{0};
    Double3 normal{0};      ///< unit length
    Double3 gradient_u{0};  ///< of the coordinate u, 1 / metres
    Double3 gradient_v{0};
};

/// Gradients are not finite when the corners lie on one line.
MIR_HD inline TriangleFrame triangle_frame(Vec3 a, Vec3 b, Vec3 c) {
    TriangleFrame f;
    f.corner = Double3(a);
    f.e1 = strict::sub(Double3(b), f.corner);
    f.e2 = strict::sub(Double3(c), f.corner);
    const Double3 n = strict::cross(f.e1, f.e2);
    const double squared = strict::dot(n, n);
    f.normal = strict::div(n, strict::sqrt(squared));
    f.gradient_u = strict::div(strict::cross(f.e2, n), squared);
    f.gradient_v = strict::div(strict::cross(n, f.e1), squared);
    return f;
}

MIR_HD inline AffineRow row_through(Double3 gradient, Double3 zero) {
    return {static_cast<float>(gradient.x), static_cast<float>(gradient.y),
            static_cast<float>(gradient.z), static_cast<float>(-strict::dot(gradient, zero))};
}

MIR_HD inline bool is_finite_row(AffineRow r) {
    const auto finite = [](float x) { return is_finite(static_cast<double>(x)); };
    return finite(r.x) && finite(r.y) && finite(r.z) && finite(r.w);
}

}  // namespace detail

/// Rows of a triangle that no segment crosses.
[[nodiscard]] MIR_HD inline TriangleRows uncrossable_rows() {
    return {{0, 0, 0, -1}, {0, 0, 0, -1}, {0, 0, 0, 1}};
}

/// Rows of the triangle a, b, c (metres), computed in double precision and rounded once. Triangles
/// without area, and those whose rows do not fit into single precision, are never crossed. The same
/// bits on host and device.
[[nodiscard]] MIR_HD inline TriangleRows make_triangle_rows(Vec3 a, Vec3 b, Vec3 c) {
    const detail::TriangleFrame f = detail::triangle_frame(a, b, c);
    const TriangleRows rows{detail::row_through(f.gradient_u, f.corner),
                            detail::row_through(f.gradient_v, f.corner),
                            detail::row_through(f.normal, f.corner)};
    const bool usable = detail::is_finite_row(rows.u) && detail::is_finite_row(rows.v) &&
                        detail::is_finite_row(rows.s);
    return usable ? rows : uncrossable_rows();
}

/// True when the segment crosses the triangle. Its ends lie strictly on opposite sides of the
/// plane, and it passes inside the three edges, or outside of them by no more than rounding can
/// hide (detail/thick_triangle.hpp). All as computed in single precision: the bit is the same when
/// the ends change places, on every processor and in every compilation. An "or" of this over all
/// triangles is what visibility means; every structure has to give that bit. It is watertight: of
/// triangles that share an edge or a vertex at least one is crossed by every segment that passes
/// there. A coordinate that is not a number crosses nothing.
[[nodiscard]] MIR_HD inline bool hits_segment(const TriangleRows& rows, Vec3 from, Vec3 to) {
    const float s_from = row_at(rows.s, from);
    const float s_to = row_at(rows.s, to);
    if (!detail::opposite(s_from, s_to)) return false;
    const detail::RowsAtEnds at = detail::rows_at_ends(rows, from, to, s_from, s_to);
    return detail::is_crossed(rows, from, to, at, detail::crossing(at));
}

namespace detail {

/// True when triangle number `triangle` is there where the segment crosses it.
template <class Mask>
MIR_HD bool is_solid(const TriangleRows& rows, Vec3 from, Vec3 to, const RowsAtEnds& at,
                     PlaneCrossing c, std::uint32_t triangle, const Mask& mask) {
    return !mask.exists() ||
           mask.is_solid(triangle, meeting_place(rows, from, to, at, c).barycentrics);
}

}  // namespace detail

/// The same of triangle number `triangle` where `mask` says that it is there. The mask is an
/// Opaque, an AlphaMaskView or a SegmentOpacity of the segment.
template <class Mask>
[[nodiscard]] MIR_HD bool hits_segment(const TriangleRows& rows, Vec3 from, Vec3 to,
                                       std::uint32_t triangle, const Mask& mask) {
    // Returns early, because a device's compiler makes other instructions of what follows.
    if constexpr (std::is_same_v<Mask, Opaque>) return hits_segment(rows, from, to);
    const float s_from = row_at(rows.s, from);
    const float s_to = row_at(rows.s, to);
    if (!detail::opposite(s_from, s_to)) return false;
    const detail::RowsAtEnds at = detail::rows_at_ends(rows, from, to, s_from, s_to);
    const detail::PlaneCrossing c = detail::crossing(at);
    return detail::is_crossed(rows, from, to, at, c) &&
           detail::is_solid(rows, from, to, at, c, triangle, mask);
}

namespace detail {

/// True when the segment meets the triangle's thin piece behind the share `t`.
MIR_HD inline bool crosses_behind(Vec3 from, Vec3 to, float s_from, float s_to, float t) {
    const float d = strict::sub(s_from, s_to);
    const float behind = strict::sub(strict::div(s_from, d), t);
    const float size = larger(max_abs(from), max_abs(to));
    return strict::mul(behind, fabsf(d)) > strict::mul(0x1p-19f, size);
}

}  // namespace detail

/// Replaces `best` when the segment crosses triangle number `triangle` before it. At the same
/// computed place the smaller number wins, so the first crossing does not depend on the order in
/// which triangles are asked. Crosses exactly when hits_segment() with the same mask says so.
template <class Mask = Opaque>
MIR_HD void keep_closer(const TriangleRows& rows, Vec3 from, Vec3 to, std::uint32_t triangle,
                        TriangleHit& best, const Mask& mask = {}) {
    const float s_from = row_at(rows.s, from);
    const float s_to = row_at(rows.s, to);
    if (!detail::opposite(s_from, s_to)) return;
    if (detail::crosses_behind(from, to, s_from, s_to, best.t)) return;
    const detail::RowsAtEnds at = detail::rows_at_ends(rows, from, to, s_from, s_to);
    const detail::PlaneCrossing c = detail::crossing(at);
    if (!detail::is_crossed(rows, from, to, at, c)) return;
    const detail::MeetingPlace place = detail::meeting_place(rows, from, to, at, c);
    if (place.t > best.t || (place.t == best.t && triangle >= best.triangle)) return;
    if (mask.exists() && !mask.is_solid(triangle, place.barycentrics)) return;
    const bool by_edge = !detail::EdgeDepths::of(c).reach(detail::edge_doubt(from, to).of(rows));
    best = {place.t, place.barycentrics, triangle, by_edge};
}

}  // namespace mir
