// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/double3.hpp"
#include "mir/accel/triangle_mask.hpp"

namespace mir {

/// An affine function of a point p in metres: x p.x + y p.y + z p.z + w. Aligned so that the device
/// fetches it as one word.
struct alignas(16) AffineRow {
    float x = 0.0f;  ///< factor of p.x, the value's unit per metre
    float y = 0.0f;  ///< of p.y
    float z = 0.0f;  ///< of p.z
    float w = 0.0f;  ///< value at the origin
};

/// A triangle in the form in which segments are tested: three affine functions of a point. u and v
/// are the barycentric coordinates of the second and third corner along the normal, s is the signed
/// distance from the plane in metres, positive in front.
/// Source: Baldwin and Weber, "Fast ray-triangle intersections by coordinate transformation",
/// JCGT 5(3), 2016.
struct TriangleRows {
    AffineRow u;  ///< weight of the second corner
    AffineRow v;  ///< weight of the third corner
    AffineRow s;  ///< distance from the plane, metres
};

namespace detail {

/// A triangle as affine frame, double precision: a point is corner + u e1 + v e2 + s normal.
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

/// Value of an affine row at a point, in the one order of operations that all tests share.
[[nodiscard]] MIR_HD inline float row_at(AffineRow row, Vec3 p) {
    const float xy = strict::add(strict::mul(row.x, p.x), strict::mul(row.y, p.y));
    return strict::add(strict::add(xy, strict::mul(row.z, p.z)), row.w);
}

namespace detail {

/// Where a segment crosses a triangle's plane, all multiplied by d: U and V are the barycentric
/// coordinates u and v times d. They change sign, and nothing else, when the ends change places.
struct PlaneCrossing {
    float d = 0.0f;
    float u = 0.0f;
    float v = 0.0f;
};

MIR_HD inline bool is_inside(PlaneCrossing c) {
    const float w = strict::sub(strict::sub(c.d, c.u), c.v);
    return c.d > 0.0f ? c.u >= 0.0f && c.v >= 0.0f && w >= 0.0f
                      : c.u <= 0.0f && c.v <= 0.0f && w <= 0.0f;
}

/// The ends lie strictly on opposite sides. By the product, which also refuses segments so short
/// that it vanishes: what follows would have no digits left.
MIR_HD inline bool opposite(float s_from, float s_to) { return strict::mul(s_from, s_to) < 0.0f; }

MIR_HD inline PlaneCrossing crossing(float u_from, float v_from, float s_from, float u_to,
                                     float v_to, float s_to) {
    PlaneCrossing c;
    c.d = strict::sub(s_to, s_from);
    c.u = strict::sub(strict::mul(u_from, s_to), strict::mul(u_to, s_from));
    c.v = strict::sub(strict::mul(v_from, s_to), strict::mul(v_to, s_from));
    return c;
}

MIR_HD inline PlaneCrossing crossing(const TriangleRows& rows, Vec3 from, Vec3 to, float s_from,
                                     float s_to) {
    return crossing(row_at(rows.u, from), row_at(rows.v, from), s_from, row_at(rows.u, to),
                    row_at(rows.v, to), s_to);
}

}  // namespace detail

/// True when the segment crosses the triangle: its ends lie strictly on opposite sides of the plane
/// and the crossing lies inside the three closed edges, all as computed in single precision. No
/// division; the bit is the same when the ends change places, on every processor and in every
/// compilation. An "or" of this over all triangles is what visibility means; every structure has to
/// give that bit. A coordinate that is not a number crosses nothing.
[[nodiscard]] MIR_HD inline bool hits_segment(const TriangleRows& rows, Vec3 from, Vec3 to) {
    const float s_from = row_at(rows.s, from);
    const float s_to = row_at(rows.s, to);
    return detail::opposite(s_from, s_to) &&
           detail::is_inside(detail::crossing(rows, from, to, s_from, s_to));
}

namespace detail {

/// Barycentrics of the second and third corner; the same when the ends change places.
MIR_HD inline Vec2 barycentrics_of(PlaneCrossing c) {
    return {strict::div(c.u, c.d), strict::div(c.v, c.d)};
}

/// True when triangle number `triangle` is there where it is crossed.
template <class Mask>
MIR_HD bool is_solid(const Mask& mask, std::uint32_t triangle, PlaneCrossing c) {
    return !mask.exists() || mask.is_solid(triangle, barycentrics_of(c));
}

}  // namespace detail

/// The same of triangle number `triangle`, which `mask` may say not to be there where it is
/// crossed: an Opaque or an AlphaMaskView.
template <class Mask>
[[nodiscard]] MIR_HD bool hits_segment(const TriangleRows& rows, Vec3 from, Vec3 to,
                                       std::uint32_t triangle, const Mask& mask) {
    // Not by way of what follows, of which a device's compiler makes other instructions.
    if constexpr (std::is_same_v<Mask, Opaque>) return hits_segment(rows, from, to);
    const float s_from = row_at(rows.s, from);
    const float s_to = row_at(rows.s, to);
    if (!detail::opposite(s_from, s_to)) return false;
    const detail::PlaneCrossing c = detail::crossing(rows, from, to, s_from, s_to);
    return detail::is_inside(c) && detail::is_solid(mask, triangle, c);
}

/// What a ray met.
struct TriangleHit {
    static constexpr std::uint32_t none = 0xFFFFFFFFu;  ///< no index: nothing was met

    float t = 1.0f;                 ///< along the segment, 0 at its start and 1 at its end
    Vec2 barycentrics{0};           ///< weights of the second and third corner
    std::uint32_t triangle = none;  ///< index, or `none`
};

/// Replaces `best` when the segment crosses triangle number `triangle` before it, or at the same
/// computed place and with a smaller number: the first crossing then does not depend on the order
/// in which triangles are asked. Crosses exactly when hits_segment() with the same mask says so.
template <class Mask = Opaque>
MIR_HD void keep_closer(const TriangleRows& rows, Vec3 from, Vec3 to, std::uint32_t triangle,
                        TriangleHit& best, const Mask& mask = {}) {
    const float s_from = row_at(rows.s, from);
    const float s_to = row_at(rows.s, to);
    if (!detail::opposite(s_from, s_to)) return;
    const float t = strict::div(s_from, strict::sub(s_from, s_to));
    if (t > best.t || (t == best.t && triangle >= best.triangle)) return;
    const detail::PlaneCrossing c = detail::crossing(rows, from, to, s_from, s_to);
    if (!detail::is_inside(c)) return;
    const Vec2 barycentrics = detail::barycentrics_of(c);
    if (mask.exists() && !mask.is_solid(triangle, barycentrics)) return;
    best = {t, barycentrics, triangle};
}

}  // namespace mir
