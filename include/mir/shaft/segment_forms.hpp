// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/triangle_rows.hpp"

#include <cmath>

namespace mir {

/// An AffineRow without defaults, which the device would write for every triangle that is tested.
struct alignas(16) PlainRow {
    float x;  ///< factor of p.x
    float y;  ///< of p.y
    float z;  ///< of p.z
    float w;  ///< value at the origin
};

/// A triangle as the segments of one pyramid are tested against it: affine functions of the
/// segments' ends, given by their difference from the centre of the pyramid's base. Source and
/// names: occlusion.hpp. Without defaults.
struct SegmentForms {
    PlainRow beyond;  ///< s': distance beyond the plane as seen from the apex, metres
    PlainRow u;       ///< U, metres
    PlainRow v;       ///< V, metres
    float depth;      ///< S: distance of the apex from the plane, metres
    float margin;     ///< of U, V and W, metres
};

namespace detail {

/// For bounds, which have margins for rounding.
MIR_HD inline float loose_dot(Vec3 a, Vec3 b) {
    return loose::mul_add(a.z, b.z, loose::mul_add(a.y, b.y, strict::mul(a.x, b.x)));
}

/// Value of an AffineRow or a PlainRow at a point, likewise: no worse than row_at().
template <class Row>
MIR_HD inline float loose_at(const Row& row, Vec3 p) {
    return strict::add(loose_dot({row.x, row.y, row.z}, p), row.w);
}

}  // namespace detail

namespace detail {

/// The least of U, V and W; no number if one of them is none.
MIR_HD inline float least_edge(float u, float v, float w) {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
    float least = 0.0f;
    asm("min.NaN.f32 %0, %1, %2;" : "=f"(least) : "f"(u), "f"(v));
    asm("min.NaN.f32 %0, %0, %1;" : "+f"(least) : "f"(w));
    return least;
#else
    // smaller() returns what it is given second where it cannot compare: W, which is no number
    // where U or V is none.
    return smaller(smaller(u, v), w);
#endif
}

}  // namespace detail

/// The forms at one end of a segment.
struct SegmentValues {
    float beyond = 0.0f;  ///< s', metres
    float edge = 0.0f;    ///< least of U, V and W, metres; no number if one is none
};

/// At the point that lies at `end` from the centre of the base.
[[nodiscard]] MIR_HD inline SegmentValues values_at(const SegmentForms& f, Vec3 end) {
    const float beyond = detail::loose_at(f.beyond, end);
    const float u = detail::loose_at(f.u, end);
    const float v = detail::loose_at(f.v, end);
    const float w = strict::sub(strict::sub(strict::add(beyond, f.depth), u), v);
    return {beyond, detail::least_edge(u, v, w)};
}

/// hits_segment() is true, whatever is rounded. `plane` is the margin of s', metres. docs/shafts.md
/// derives the margins.
[[nodiscard]] MIR_HD inline bool surely_hit(SegmentValues at, const SegmentForms& f, float plane) {
    return (at.beyond > plane) & (at.edge > f.margin);
}

/// hits_segment() is false, whatever is rounded.
[[nodiscard]] MIR_HD inline bool surely_missed(SegmentValues at, const SegmentForms& f,
                                               float plane) {
    return (at.beyond < -plane) | (at.edge < -f.margin);
}

}  // namespace mir
