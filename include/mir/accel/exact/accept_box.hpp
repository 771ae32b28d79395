// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/scene/world_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

// hits_segment() rounds, so it also accepts segments that pass a triangle at a small distance. A
// structure that culls with boxes gives its bits only if the boxes hold all places where it may
// accept. This header computes such boxes.
//
// Let M be the largest |coordinate| of all corners, let the ends p, q of segments keep within
// reach() = 1.5 M, e = 2^-24, g_u = |gradient of u|_1, g_v the same, G = g_u + g_v.
//
// Lemma. If hits_segment() is true there is a point X on the segment with
//   |s(X)| <= 41 e M, u(X) >= -28 e M g_u, v(X) >= -28 e M g_v, w(X) >= -(28 e M G + 10 e).
// Proof. A row with gradient g is computed with an error of at most e times: g 1.5 M (products),
// g (1.5 + 1.5 + 2.5) M (sums), g (1.5 + 1) M (storing gradient and offset) = 9.5 e g M; below
// 9.5 sqrt(3) e M < 17 e M for s. At the place that keeps_edges() found the mean of the computed
// values keeps 16, 12, 12 and 12 G + 8 e, in units of e times 1.5 M, and so the true values those
// plus that error; its own rounding is a few e of these, and 2 e of w. A segment that is_inside()
// alone accepted is such a one, too: let X be the point that divides it in the ratio of its
// computed distances |s_p| : |s_q|, D their sum. The mean of s is 0 there. U / D is that of u, and
// sign(U) is wrong only below e (|u_p| |s_q| + |u_q| |s_p|) / D <= 2.5 e M g_u. W takes two more
// subtractions and d: 2 e + 2.5 e M (3 g_u + 2 g_v) in all. Underflow adds below 2^-75, since
// opposite() keeps D > 2^-74.
//
// Contract. accept_margin_of() = 64 e M leaves 14 e M in every direction, and a traversal may use
// them up: walking with rounded plane distances it may find X up to 14 e M outside of a cell that
// it visits (kd_traverse.hpp). In return it needs no slack of its own, provided that each leaf
// lists every triangle whose accept_box() shares a point with the leaf's closed cell. A builder
// that clips triangles may leave those out that stay farther than overshoot() from the cell in some
// axis.

/// Largest |coordinate| in a box, metres: the M of the error bounds. Zero for an empty box.
[[nodiscard]] inline float magnitude_of(const Bounds& box) {
    return box.empty() ? 0.0f : larger(max_abs(box.low), max_abs(box.high));
}

/// Largest |coordinate| of segments' ends for which the bounds hold, metres. Farther segments are
/// cut to that cube first (reach.hpp).
[[nodiscard]] MIR_HD inline float reach_of(float magnitude) { return 1.5f * magnitude; }

/// Unit of the margins of shafts, metres. More than twice what rounding displaces a point of a
/// segment, or a triangle's plane, per axis.
[[nodiscard]] MIR_HD inline double sigma_of(float magnitude) {
    return 32.0 * 0x1p-24 * static_cast<double>(magnitude);
}

/// Largest distance in metres, per axis, between a crossing segment and its triangle's plane. Or an
/// edge in the plane; the rounding of traversal is included.
[[nodiscard]] MIR_HD inline double accept_margin_of(float magnitude) {
    return 2.0 * sigma_of(magnitude);
}

/// sigma_of() a scene that is known by its reach_of() alone, up to rounding.
[[nodiscard]] inline float sigma_of_reach(float reach) {
    return static_cast<float>(sigma_of(reach) / 1.5);
}

namespace detail {

/// Where segments are accepted, projected on the triangle's plane: a triangle around the triangle.
struct AcceptTriangle {
    Double3 a{0};
    Double3 b{0};
    Double3 c{0};
};

MIR_HD inline AcceptTriangle accept_triangle(const TriangleFrame& f, double margin) {
    const double e_u = strict::mul(margin, l1_norm(f.gradient_u));
    const double e_v = strict::mul(margin, l1_norm(f.gradient_v));
    const double e_w = strict::add(strict::add(e_u, e_v), 0x1p-20);
    const double far_u = strict::add(strict::add(1.0, e_v), e_w);
    const double far_v = strict::add(strict::add(1.0, e_u), e_w);
    AcceptTriangle t;
    t.a = strict::sub(strict::sub(f.corner, strict::mul(e_u, f.e1)), strict::mul(e_v, f.e2));
    t.b = strict::sub(strict::add(f.corner, strict::mul(far_u, f.e1)), strict::mul(e_v, f.e2));
    t.c = strict::add(strict::sub(f.corner, strict::mul(e_u, f.e1)), strict::mul(far_v, f.e2));
    return t;
}

/// Triangles that are never crossed have no frame; their corners will do.
MIR_HD inline AcceptTriangle accept_triangle(Vec3 a, Vec3 b, Vec3 c, float magnitude) {
    const AcceptTriangle t = accept_triangle(triangle_frame(a, b, c), accept_margin_of(magnitude));
    const double all = strict::add(strict::add(l1_norm(t.a), l1_norm(t.b)), l1_norm(t.c));
    return is_finite(all) ? t : AcceptTriangle{Double3(a), Double3(b), Double3(c)};
}

MIR_HD inline float rounded_down(double x) {
    const auto f = static_cast<float>(x);
    return static_cast<double>(f) > x ? nextafterf(f, -INFINITY) : f;
}
MIR_HD inline float rounded_up(double x) { return -rounded_down(-x); }

MIR_HD inline Bounds rounded_outwards(Double3 low, Double3 high) {
    return {{rounded_down(low.x), rounded_down(low.y), rounded_down(low.z)},
            {rounded_up(high.x), rounded_up(high.y), rounded_up(high.z)}};
}

}  // namespace detail

/// Box around all places where hits_segment() may accept a segment for a triangle. The triangle is
/// a, b, c; traversal may look for it there. Rounded outwards. `magnitude` is magnitude_of() the
/// bounds of the whole scene, metres. Cut to the cube of reach_of(magnitude), because needles would
/// have boxes without end; no segment lies outside. The same bits on host and device.
[[nodiscard]] MIR_HD inline Bounds accept_box(Vec3 a, Vec3 b, Vec3 c, float magnitude) {
    const detail::AcceptTriangle t = detail::accept_triangle(a, b, c, magnitude);
    const detail::Double3 margin(accept_margin_of(magnitude));
    const detail::Double3 reach(static_cast<double>(reach_of(magnitude)));
    const detail::Double3 low = detail::smaller_axes(t.a, detail::smaller_axes(t.b, t.c));
    const detail::Double3 high = detail::larger_axes(t.a, detail::larger_axes(t.b, t.c));
    return detail::rounded_outwards(strict::sub(detail::larger_axes(low, -reach), margin),
                                    strict::add(detail::smaller_axes(high, reach), margin));
}

/// Largest distance of accept_box()'s region from the triangle itself, rounded up. Per axis and in
/// metres. Boxes around clipped parts of a triangle grow by it.
[[nodiscard]] inline float overshoot(Vec3 a, Vec3 b, Vec3 c, float magnitude) {
    const detail::AcceptTriangle t = detail::accept_triangle(a, b, c, magnitude);
    const auto largest = [](detail::Double3 v) {
        return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
    };
    const double moved =
        std::max(largest(t.a - detail::Double3(a)),
                 std::max(largest(t.b - detail::Double3(b)), largest(t.c - detail::Double3(c))));
    return detail::rounded_up(moved + accept_margin_of(magnitude));
}

}  // namespace mir
