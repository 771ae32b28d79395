// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/ray.hpp"
#include "mir/core/strict_float.hpp"

namespace mir {

// Rounding grows with coordinates, so the error bounds of accept_box.hpp hold in a cube around the
// origin that is somewhat larger than the scene. Segments and rays that leave it are cut to it
// before anything else, by functions of the segment and the cube alone: no triangle is lost, and
// the answer stays the same for every structure.

/// Part of a segment or ray inside the cube of half edge `reach`.
struct CutSegment {
    Vec3 from{0};           ///< metres; means nothing when `empty`
    Vec3 to{0};             ///< the same
    bool empty = false;     ///< it misses the cube
    float t_from = 0.0f;    ///< rays: distance of `from` from the origin, metres
    float t_length = 0.0f;  ///< rays: distance from `from` to `to`, metres
};

/// Where on a cut ray a distance of `metres` from its origin lies, as a share of the segment, a
/// little beyond; 1 at most.
[[nodiscard]] MIR_HD inline float share_at(const CutSegment& cut, float metres) {
    return smaller((metres - cut.t_from) / cut.t_length * (1.0f + 0x1p-10f) + 0x1p-20f, 1.0f);
}

/// True when the point lies in the cube, which is what callers check first. Cutting is rare.
[[nodiscard]] MIR_HD inline bool within_reach(Vec3 p, float reach) { return max_abs(p) <= reach; }

namespace detail {

/// Share of the segment from a to b before the cube begins. 2 when it never does.
MIR_HD inline float share_outside(float a, float b, float reach) {
    if (fabsf(a) <= reach) return 0.0f;
    const float gap = strict::sub(a, copysignf(reach, a));
    const float length = strict::sub(a, b);
    const bool arrives = a > 0.0f ? length >= gap : length <= gap;
    return arrives ? strict::div(gap, length) : 2.0f;
}

/// The same for each axis and for all of them.
struct ShareOutside {
    Vec3 axis{0};
    float all = 0.0f;
};

MIR_HD inline ShareOutside share_outside(Vec3 a, Vec3 b, float reach) {
    const Vec3 t(share_outside(a.x, b.x, reach), share_outside(a.y, b.y, reach),
                 share_outside(a.z, b.z, reach));
    return {t, larger(t.x, larger(t.y, t.z))};
}

/// Coordinate of origin + t direction, not outside of the cube. Exactly on the face when this axis
/// decided t: nothing else is left of it when the origin is very far away.
MIR_HD inline float coordinate_in_cube(float origin, float t, float direction, float t_of_face,
                                       float face, float reach) {
    const float x = strict::add(origin, strict::mul(t, direction));
    return t == t_of_face ? face : larger(-reach, smaller(x, reach));
}

MIR_HD inline Vec3 entry_point(Vec3 a, Vec3 b, const ShareOutside& share, float reach) {
    const auto coordinate = [&](float from, float to, float t) {
        return coordinate_in_cube(from, share.all, strict::sub(to, from), t, copysignf(reach, from),
                                  reach);
    };
    return {coordinate(a.x, b.x, share.axis.x), coordinate(a.y, b.y, share.axis.y),
            coordinate(a.z, b.z, share.axis.z)};
}

/// Distances along a ray at which it passes the faces of the cube, by axis.
struct CubePassage {
    Vec3 enters{0};
    Vec3 leaves{0};
};

MIR_HD inline CubePassage cube_passage(const Ray& ray, float reach) {
    const auto passes = [reach](float origin, float direction, float side) {
        const float d = copysignf(larger(fabsf(direction), 0x1p-120f), direction);
        return strict::div(strict::sub(copysignf(reach, side * d), origin), d);
    };
    const Vec3 o = ray.origin;
    const Vec3 d = ray.direction;
    return {{passes(o.x, d.x, -1.0f), passes(o.y, d.y, -1.0f), passes(o.z, d.z, -1.0f)},
            {passes(o.x, d.x, 1.0f), passes(o.y, d.y, 1.0f), passes(o.z, d.z, 1.0f)}};
}

/// Point of the ray where it passes the faces at `t`. `side` is -1 where it enters, 1 where it
/// leaves.
MIR_HD inline Vec3 passage_point(const Ray& ray, float t, Vec3 t_of_faces, float side,
                                 float reach) {
    const auto coordinate = [=](float origin, float direction, float t_of_face) {
        return coordinate_in_cube(origin, t, direction, t_of_face,
                                  copysignf(reach, side * direction), reach);
    };
    return {coordinate(ray.origin.x, ray.direction.x, t_of_faces.x),
            coordinate(ray.origin.y, ray.direction.y, t_of_faces.y),
            coordinate(ray.origin.z, ray.direction.z, t_of_faces.z)};
}

}  // namespace detail

/// Cuts the segment from a to b, metres. Ends inside keep their bits; exchanging the ends exchanges
/// `from` and `to` and changes nothing else.
[[nodiscard]] MIR_HD inline CutSegment cut_to_reach(Vec3 a, Vec3 b, float reach) {
    const detail::ShareOutside from_a = detail::share_outside(a, b, reach);
    const detail::ShareOutside from_b = detail::share_outside(b, a, reach);
    CutSegment cut{a, b};
    cut.empty = !(strict::add(from_a.all, from_b.all) <= 1.0f);
    if (from_a.all > 0.0f) cut.from = detail::entry_point(a, b, from_a, reach);
    if (from_b.all > 0.0f) cut.to = detail::entry_point(b, a, from_b, reach);
    return cut;
}

/// Cuts the segment from `a` to `b` where it must be cut, which is rare. False when nothing of it
/// is left.
[[nodiscard]] MIR_HD inline bool is_left_within_reach(Vec3& a, Vec3& b, float reach) {
    if (within_reach(a, reach) && within_reach(b, reach)) return true;
    const CutSegment cut = cut_to_reach(a, b, reach);
    if (cut.empty) return false;
    a = cut.from;
    b = cut.to;
    return true;
}

/// Cuts a ray: its other end is where it leaves the cube. An origin inside keeps its bits.
[[nodiscard]] MIR_HD inline CutSegment cut_to_reach(const Ray& ray, float reach) {
    const detail::CubePassage passage = detail::cube_passage(ray, reach);
    const bool starts_inside = within_reach(ray.origin, reach);
    const float begin =
        starts_inside
            ? 0.0f
            : larger(passage.enters.x, larger(passage.enters.y, larger(passage.enters.z, 0.0f)));
    const float end = smaller(passage.leaves.x, smaller(passage.leaves.y, passage.leaves.z));
    CutSegment cut;
    cut.from = starts_inside ? ray.origin
                             : detail::passage_point(ray, begin, passage.enters, -1.0f, reach);
    cut.to = detail::passage_point(ray, end, passage.leaves, 1.0f, reach);
    cut.empty = !(begin <= end);
    cut.t_from = begin;
    cut.t_length = strict::sub(end, begin);
    return cut;
}

}  // namespace mir
