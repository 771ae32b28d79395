// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"

#include <cmath>

namespace mir {

/// An AffineRow without defaults, which the device would write for every triangle that is tested.
struct alignas(16) PlainRow {
    float x;  ///< factor of p.x
    float y;  ///< of p.y
    float z;  ///< of p.z
    float w;  ///< value at the origin
};

/// Least |U|, |V| and |W| for hits_segment() to agree in sign, metres.
struct EdgeMargins {
    /// Where one is larger, metres, coefficients of its plane might be infinite, or no numbers.
    static constexpr float largest = 1e30f;

    float u;  ///< of U
    float v;  ///< of V
    float w;  ///< of W, which is larger than the others
};

/// Planes of the shadow volume that a triangle casts from a pyramid's apex. Each is an affine
/// function of a segment's end in Pyramid::local() coordinates. Source and names: occlusion.hpp.
/// Without defaults.
struct ShadowPlanes {
    PlainRow beyond;      ///< s': distance beyond the plane as seen from the apex, metres
    PlainRow u;           ///< U, metres
    PlainRow v;           ///< V, metres
    PlainRow w;           ///< W, metres
    EdgeMargins margins;  ///< of U, V and W
};

namespace detail {

/// For bounds, which have margins for rounding.
MIR_HD inline float loose_dot(Vec3 a, Vec3 b) {
    return loose::mul_add(a.z, b.z, loose::mul_add(a.y, b.y, strict::mul(a.x, b.x)));
}

/// Value of a row at a point, no worse than row_at().
MIR_HD inline float loose_at(AffineRow row, Vec3 p) {
    return strict::add(loose_dot({row.x, row.y, row.z}, p), row.w);
}

/// The same in one fused operation per axis. Rounding is that of loose_at() and twice that of the
/// value at the origin.
MIR_HD inline float quick_at(const PlainRow& row, Vec3 p) {
    return loose::mul_add(row.z, p.z,
                          loose::mul_add(row.y, p.y, loose::mul_add(row.x, p.x, row.w)));
}

/// `factor` times a row, plus `shift`.
MIR_HD inline PlainRow scaled(const PlainRow& row, float factor, float shift) {
    return {strict::mul(row.x, factor), strict::mul(row.y, factor), strict::mul(row.z, factor),
            loose::mul_add(row.w, factor, shift)};
}

/// The least of four numbers; no number where all are none. Some alone are not left out to be none:
/// planes are finite, so that only an end which is no number, and is hit by nothing, makes them so.
MIR_HD inline float least(float a, float b, float c, float d) {
    return fminf(fminf(a, b), fminf(c, d));
}

}  // namespace detail

/// ShadowPlanes in units of their margins, hits at 1 and misses at -1. One number tells what is
/// sure of a segment. Without defaults.
struct SurePlanes {
    PlainRow beyond;  ///< s'
    PlainRow u;       ///< U; constant and nearer to 0, as V and W, where nothing is sure of it
    PlainRow v;       ///< V
    PlainRow w;       ///< W

    /// Above 1 where hits_segment() is surely true, below -1 where false. The end has the local
    /// coordinates `end`, metres. No number where `end` is none.
    [[nodiscard]] MIR_HD float at(Vec3 end) const {
        return detail::least(detail::quick_at(beyond, end), detail::quick_at(u, end),
                             detail::quick_at(v, end), detail::quick_at(w, end));
    }
};

namespace detail {

/// Margins of a plane for hits and for misses, over those for misses. What lies between them is
/// open.
struct OpenRange {
    float hit;  ///< of the margin, above 0 and at most 1

    /// Of the margin: what is scaled to 1.
    [[nodiscard]] MIR_HD constexpr float half() const { return 0.5f * (1.0f + hit); }
    /// What moves the middle of the range to 0 then.
    [[nodiscard]] MIR_HD constexpr float shift() const { return (1.0f - hit) / (1.0f + hit); }
};

MIR_HD inline PlainRow in_margins(const PlainRow& row, float margin, OpenRange range) {
    if (!(margin <= EdgeMargins::largest)) return {0.0f, 0.0f, 0.0f, range.shift()};
    return scaled(row, loose::rough_reciprocal(range.half() * margin), range.shift());
}

}  // namespace detail

/// Planes by which hits_segment() is sure to hit above 1 and to miss below -1. `plane` is the
/// margin of s' for hits, metres, 2^-120 or more like the others, and `hit` the share of the other
/// margins that hits need. docs/shaft_proofs.md derives them.
[[nodiscard]] MIR_HD inline SurePlanes in_margins(const ShadowPlanes& planes, float plane,
                                                  float hit) {
    const detail::OpenRange range{hit};
    const float plane_of_misses = plane / hit;
    return {detail::scaled(planes.beyond, loose::rough_reciprocal(range.half() * plane_of_misses),
                           range.shift()),
            detail::in_margins(planes.u, planes.margins.u, range),
            detail::in_margins(planes.v, planes.margins.v, range),
            detail::in_margins(planes.w, planes.margins.w, range)};
}

}  // namespace mir
